"""Symmetric tensors: six components or 3x3.

One convention everywhere: tension is positive, components stand in the order xx yy zz xy xz yz, and shear components
are those of the tensor (eps_xy = gamma_xy/2). Functions take either form and return six components.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hypofab.errors import InputError, Status

Array = NDArray[np.float64]

COMPONENTS = ("xx", "yy", "zz", "xy", "xz", "yz")

_ROWS, _COLUMNS = [0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]
_PLACES = [[0, 3, 4], [3, 1, 5], [4, 5, 2]]
_WEIGHTS = np.array([1.0, 1, 1, 2, 2, 2])


def components(tensor: ArrayLike, name: str = "tensor") -> Array:
    """Six components of one tensor, given as six numbers or as a symmetric 3x3 matrix; a copy.

    `name` is what the message of a wrong shape calls it.
    """
    array = np.array(tensor, dtype=np.float64)
    if array.shape == (3, 3):
        if not np.allclose(array, array.T, rtol=1e-12, atol=1e-14 * np.abs(array).max(initial=0)):
            raise InputError(f"{name} is a 3x3 matrix that is not symmetric", Status.BAD_ARGUMENT)
        return array[_ROWS, _COLUMNS]
    if array.shape != (6,):
        raise InputError(
            f"{name} has the shape {array.shape}, expected six components xx yy zz xy xz yz or a 3x3 matrix",
            Status.BAD_ARGUMENT,
        )
    return array


def many_components(tensors: ArrayLike, name: str = "tensors") -> Array:
    """The same for several tensors: (n, 6), or (n, 3, 3)."""
    array = np.asarray(tensors, dtype=np.float64)
    if array.ndim == 3 and array.shape[1:] == (3, 3):
        if not np.allclose(array, np.swapaxes(array, 1, 2), rtol=1e-12, atol=1e-14 * np.abs(array).max(initial=0)):
            raise InputError(f"{name} holds a 3x3 matrix that is not symmetric", Status.BAD_ARGUMENT)
        return array[:, _ROWS, _COLUMNS]
    if array.ndim != 2 or array.shape[1] != 6:
        raise InputError(f"{name} has the shape {array.shape}, expected (n, 6) or (n, 3, 3)", Status.BAD_ARGUMENT)
    return array


def matrix(tensor: ArrayLike) -> Array:
    """The 3x3 matrix of six components; of (..., 6) components (..., 3, 3)."""
    return np.asarray(tensor, dtype=np.float64)[..., _PLACES]


def contraction(a: ArrayLike, b: ArrayLike) -> Array:
    """Double contraction a:b of six components; of (..., 6) an array."""
    return np.sum(_WEIGHTS * np.asarray(a) * np.asarray(b), axis=-1)


def coordinates(basis: Array, tensors: ArrayLike) -> Array:
    """Coordinates of tensors (..., 6) in the space of an orthonormal basis (dimension, 6): shape (..., dimension)."""
    return (_WEIGHTS * np.asarray(tensors)) @ basis.T


def norm(tensor: ArrayLike) -> Array:
    """Frobenius norm of six components, |X| = sqrt(X:X); of (..., 6) an array."""
    return np.sqrt(np.sum(_WEIGHTS * np.asarray(tensor, dtype=np.float64) ** 2, axis=-1))


def mean_stress(stress: ArrayLike) -> Array:
    """P = -tr(T)/3, positive in compression."""
    return -np.sum(np.asarray(stress, dtype=np.float64)[..., :3], axis=-1) / 3


def deviatoric_stress(stress: ArrayLike) -> Array:
    """Q = sqrt(3/2 s:s)."""
    stress = np.asarray(stress, dtype=np.float64)
    deviator = stress + mean_stress(stress)[..., np.newaxis] * np.array([1.0, 1, 1, 0, 0, 0])
    return np.sqrt(1.5) * norm(deviator)


def read_only(array: ArrayLike) -> Array:
    """The same array, not to be written to: fields of frozen dataclasses."""
    array = np.asarray(array)
    array.flags.writeable = False
    return array
