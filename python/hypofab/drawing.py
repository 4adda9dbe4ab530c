"""The one way from results to their figures: hypofab.figures, and matplotlib with it, are loaded when one is drawn."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def draw(function: str, *arguments: Any, **options: Any) -> "Figure":  # noqa: ANN401 - those of the function
    """What a function of hypofab.figures draws, named "module.function"."""
    module, name = function.split(".")
    return getattr(import_module(f"hypofab.figures.{module}"), name)(*arguments, **options)
