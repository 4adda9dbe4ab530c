"""The "measured" files of this folder: element tests of a built-in sand, with noise of half a per cent of each range.

    python make_tests.py      (needs the package: pip install .)

sand.yaml then finds the parameters of that sand again.
"""

from pathlib import Path

import numpy as np

import hypofab

SAND = hypofab.Material.sand("hochstetten")
NOISE = 0.005
HERE = Path(__file__).parent


def run(direction: list[float], stress: list[float], void_ratio: float, steps: list[dict]) -> np.ndarray:
    """Rows of a test that begins with delta mobilised by compression in a direction (compression positive)."""
    delta = -SAND.R * np.array([*direction, 0, 0, 0]) / np.linalg.norm(direction)
    state = hypofab.State(stress=-np.array([*stress, 0, 0, 0]), delta=delta, void_ratio=void_ratio)
    return hypofab.element_test(SAND, state, [{"axis": "z"} | step for step in steps]).rows


def write(
    name: str, columns: dict[str, np.ndarray], generator: np.random.Generator, controlled: tuple[str, ...] = ()
) -> None:
    """One CSV file; the first row stays without noise, and so does what the apparatus controls."""
    for column, values in columns.items():
        if column in controlled:
            continue
        scale = np.log(values) if column == "sigma1_kPa" else values
        noise = NOISE * np.ptp(scale) * generator.standard_normal(len(values))
        noise[0] = 0
        columns[column] = np.exp(scale + noise) if column == "sigma1_kPa" else values + noise
    table = np.column_stack(list(columns.values()))
    np.savetxt(HERE / f"{name}.csv", table, "%.6g", delimiter=",", header=",".join(columns), comments="")


def triaxial(
    name: str,
    pressure: float,
    void_ratio: float,
    steps: list[dict],
    generator: np.random.Generator,
    controlled: tuple[str, ...] = (),
) -> None:
    """A drained triaxial test."""
    rows = run([1, 1, 1], [pressure] * 3, void_ratio, steps)
    strains = {"eps1_pct": -100 * rows["eps_zz"], "epsv_pct": -100 * rows["eps_v"]}
    write(name, strains | {"q_kPa": rows["q_signed"]}, generator, controlled)


def to(preset: str, quantity: str, value: float, rows: int) -> dict:
    """A step."""
    return {"preset": preset, "until": {"quantity": quantity, "value": value}, "rows": rows}


def main() -> None:
    """All files."""
    generator = np.random.default_rng(2026)
    for name, void_ratio in (("oedometer_loose", 0.85), ("oedometer_dense", 0.65)):
        loading = [to("oedometer_loading", "sig_zz", -10 * 10 ** (k / 4), 6) for k in range(1, 9)]
        unloading = [to("oedometer_unloading", "sig_zz", -1000 * 10 ** (-k / 4), 4) for k in range(1, 5)]
        rows = run([0, 0, 1], [4.5, 4.5, 10], void_ratio, loading + unloading)
        write(name, {"sigma1_kPa": -rows["sig_zz"], "e": rows["void_ratio"]}, generator)
    for name, pressure, void_ratio in (("drained_dense", 100, 0.65), ("drained_loose", 200, 0.82)):
        steps = [to("drained_triaxial_compression", "eps_zz", value, 25) for value in (-0.02, -0.15)]
        triaxial(name, pressure, void_ratio, steps, generator)
    compression, extension = (f"drained_triaxial_{word}" for word in ("compression", "extension"))
    cycles = [to(compression, "q_signed", 60, 20), to(extension, "q_signed", 10, 20)] * 2
    last = to(compression, "q_signed", 60, 20)
    triaxial("small_cycles", 100, 0.7, [*cycles, last], generator, controlled=("q_kPa",))


if __name__ == "__main__":
    main()
