"""Attributes that materials and states have from the descriptions of models: described.pyi names them to type checkers.

scripts/python_stub.py writes described.pyi.
"""


class ParameterNames:
    """Attributes of a material."""

    __slots__ = ()


class VariableNames:
    """Attributes of a state, beside its stress."""

    __slots__ = ()


class RateNames:
    """Attributes of rates and of many points."""

    __slots__ = ()
