"""The package without the compiled library, as it is in the source tree."""

import importlib.util
import pkgutil

import pytest

import hypofab


def test_no_public_name_is_that_of_a_module() -> None:
    """`from hypofab import NAME` would otherwise mean the one or the other, whichever was loaded first."""
    modules = {module.name for module in pkgutil.iter_modules(hypofab.__path__)}
    assert not modules & set(hypofab.__all__)


@pytest.mark.skipif(importlib.util.find_spec("hypofab._core") is not None, reason="the compiled library is here")
def test_what_needs_the_compiled_library_says_so() -> None:
    assert issubclass(hypofab.InputError, hypofab.HypofabError)
    assert "update_many" in dir(hypofab)
    with pytest.raises(ImportError, match="pip install"):
        hypofab.update_many  # noqa: B018
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        hypofab.nothing  # noqa: B018
