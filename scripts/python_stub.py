"""Write python/hypofab/model/described.pyi: parameters and state variables of the models, for type checkers.

Run with a Python that has the package: `python scripts/python_stub.py`. A test compares file and text.
"""

from pathlib import Path

from hypofab.model.registry import Model, models

FILE = Path(__file__).resolve().parents[1] / "python" / "hypofab" / "model" / "described.pyi"


def names_of(title: str, described: dict[str, tuple[str, str]], base: str = "") -> list[str]:
    """A class with typed attributes and their descriptions."""
    lines = ["", f"class {title}{f'({base})' if base else ''}:"]
    for name, (kind, description) in described.items():
        lines += [f"    {name}: {kind}", f'    """{description}"""']
    return lines


def text(known: list[Model]) -> str:
    """What described.pyi is to hold."""
    parameters = {one.name: ("float", one.description) for model in known for one in model.parameters.values()}
    variables = {one.name: one for model in known for one in model.variables.values()}
    of_state = {one.name: ("float" if one.size == 1 else "Array", one.description) for one in variables.values()}
    of_rate = {one.name: ("Array", f"{one.description}; of points (n,) or (n, 6)") for one in variables.values()}
    return "\n".join(
        [
            '"""Written by scripts/python_stub.py from the descriptions of the models."""',
            "",
            "from hypofab.tensors import Array",
            *names_of("ParameterNames", parameters),
            *names_of("VariableNames", of_state),
            *names_of("RateNames", of_rate),
            "",
        ]
    )


if __name__ == "__main__":
    FILE.write_text(text(list(models().values())), encoding="utf-8")
    print(FILE)
