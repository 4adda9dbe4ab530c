"""Element tests from files, mappings and objects: the bits of the program's result files, and threads."""

import csv
import os
import signal
import threading
from concurrent.futures import ThreadPoolExecutor
from inspect import signature
from pathlib import Path

import numpy as np
import pytest

import hypofab
from hypofab.cli.launch import packaged_program

TENSORS = ("xx", "yy", "zz", "xy", "xz", "yz")


def read(path: Path) -> dict[str, list[float]]:
    with path.open(newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


def program(*arguments: str | Path, expected: int = 0) -> None:
    status = os.spawnv(os.P_WAIT, packaged_program(), ["hypofab", *map(str, arguments)])
    assert status == expected


def assert_same(result: hypofab.TestResult, columns: dict[str, list[float]]) -> None:
    assert list(result.rows.dtype.names) == list(columns)
    for name, values in columns.items():
        assert np.array_equal(result[name], values, equal_nan=True), name


@pytest.mark.parametrize("deck", ["directional_stiffness", "oedometer", "undrained_cyclic", "general_control"])
def test_a_deck_file_gives_the_bits_of_the_program(deck: str, examples: Path, tmp_path: Path) -> None:
    path = examples / f"{deck}.yaml"
    if not path.exists():
        pytest.skip(f"no example {deck}")
    program("run", path, "-o", tmp_path)
    results = hypofab.run(path)
    assert results
    for name, result in results.items():
        assert result.check() is result
        assert_same(result, read(tmp_path / f"{name}.csv"))


def mapping(**options: object) -> dict:
    return {
        "sign": "compression_positive",
        "materials": [{"name": "sand", "sand": "hochstetten"}],
        "states": [
            {"name": "start", "material": "sand", "p": np.float64(100), "void_ratio": 0.7, "delta": {"zero": True}}
        ],
        "tests": [
            {
                "name": "drained",
                "state": "start",
                "steps": [
                    {
                        "preset": "drained_triaxial_compression",
                        "axis": "z",
                        "until": {"quantity": "eps_zz", "value": 0.1},
                    }
                ],
            }
        ],
    } | options


def test_file_mapping_and_objects_give_the_same_bits(tmp_path: Path, sand: hypofab.Material) -> None:
    (tmp_path / "deck.yaml").write_text(
        "sign: compression_positive\n"
        "materials: [{name: sand, sand: hochstetten}]\n"
        "states: [{name: start, material: sand, p: 100, void_ratio: 0.7, delta: {zero: true}}]\n"
        "tests:\n"
        "  - name: drained\n"
        "    state: start\n"
        "    steps: [{preset: drained_triaxial_compression, axis: z, until: {quantity: eps_zz, value: 0.1}}]\n"
    )
    from_file = hypofab.run(tmp_path / "deck.yaml")["drained"]
    from_mapping = hypofab.run(mapping())["drained"]
    step = hypofab.Step(preset="drained_triaxial_compression", axis="z", until=("eps_zz", -0.1))
    from_objects = hypofab.element_test(sand, hypofab.State.isotropic(100, 0.7), step)
    assert (from_file.sign, from_mapping.sign, from_objects.sign) == (-1, -1, 1)
    for name in from_file.rows.dtype.names:
        assert np.array_equal(from_file[name], from_mapping[name], equal_nan=True)
        turned = name.startswith(("eps_x", "eps_y", "eps_z", "sig_", "delta_")) or name in ("eps_v",)
        turned |= name in ("tot_xx", "tot_yy", "tot_zz")
        sign = -1 if turned else 1
        assert np.array_equal(from_file[name], sign * from_objects[name], equal_nan=True), name


def test_state_of_objects_starts_the_test(sand: hypofab.Material, state: hypofab.State) -> None:
    step = {"control": {k: {"strain_rate": -1} for k in ("xx", "yy", "zz")}, "until": {"quantity": "p", "value": 200}}
    rows = hypofab.element_test(sand, state, step).rows
    assert [rows[f"sig_{k}"][0] for k in TENSORS] == list(state.stress)
    assert [rows[f"delta_{k}"][0] for k in TENSORS] == list(state.delta)
    assert rows["void_ratio"][0] == state.void_ratio
    assert rows["p"][-1] == pytest.approx(200)
    plain = hypofab.element_test(sand.without_intergranular_strain(), hypofab.State(state.stress, 0.7), step).rows
    assert not plain["delta_xx"].any()


def test_a_physical_end_is_in_the_result(tmp_path: Path) -> None:
    deck = mapping()
    deck["tests"][0]["steps"] = [
        {
            "control": {"xx": {"stress_rate": 0}, "yy": {"stress_rate": 0}, "zz": {"stress_rate": 1}},
            "until": {"quantity": "sig_zz", "value": 1000},
        }
    ]
    result = hypofab.run(deck)["drained"]
    assert result.status is hypofab.Status.NOT_CONTROLLABLE
    assert result.stopped_in == 1
    assert result["event"][-1] == -result.status
    with pytest.raises(hypofab.PhysicalError, match="test 'drained' stopped early: step 1: loss of controllability"):
        result.check()
    with pytest.raises(hypofab.PhysicalError, match="stopped early"):
        hypofab.Study(deck).write(tmp_path / "out")
    assert_same(result, read(tmp_path / "out" / "drained.csv"))
    assert (tmp_path / "out" / "summary.json").exists()


def test_a_wrong_deck_is_refused_with_its_place(tmp_path: Path) -> None:
    (tmp_path / "deck.yaml").write_text("materials:\n  - {name: a, sand: nowhere}\nstates: []\n")
    with pytest.raises(hypofab.InputError, match=r"deck\.yaml:") as bad:
        hypofab.Study(tmp_path / "deck.yaml")
    assert bad.value.status is hypofab.Status.BAD_FILE
    states = [{"name": "start", "material": "sand", "p": 100, "void_ratio": -0.7, "delta": {"zero": True}}]
    with pytest.raises(hypofab.InputError, match=r"^deck:\d+: states\[0\]\.void_ratio: .*expected"):
        hypofab.Study(mapping(states=states))
    with pytest.raises(hypofab.InputError, match="No such file"):
        hypofab.Study(tmp_path / "nichts-äöü.yaml")
    with pytest.raises(hypofab.InputError, match="no test 'x', expected one of drained"):
        hypofab.Study(mapping()).run_test("x")
    with pytest.raises(hypofab.InputError, match="a deck holds no object"):
        hypofab.Study(mapping(title=object()))


def test_contacts_of_a_mapping_are_beside_its_folder(examples: Path) -> None:
    delta = {"contacts": "data/aniso_3000_contacts.txt.gz", "particles": "data/aniso_3000_particles.txt.gz"}
    states = [{"name": "start", "material": "sand", "p": 100, "void_ratio": 0.7, "delta": delta}]
    material, state = hypofab.Study(mapping(states=states), folder=examples).state("start")
    fabric = hypofab.fabric_of_file(examples / delta["contacts"], particles=examples / delta["particles"])
    assert np.array_equal(state.delta, fabric.delta(material.R).delta)
    assert material == hypofab.Material.sand("hochstetten")


def test_envelopes_are_written(examples: Path, tmp_path: Path) -> None:
    study = hypofab.Study(examples / "response_envelopes.yaml")
    study.write_envelopes(tmp_path / "a")
    program("envelope", examples / "response_envelopes.yaml", "-o", tmp_path / "b")
    assert study.envelopes
    for name in study.envelopes:
        assert (tmp_path / "a" / f"{name}.csv").read_bytes() == (tmp_path / "b" / f"{name}.csv").read_bytes()


def cycles(count: int) -> hypofab.Step:
    cycle = {"quantity": "eps_zz", "amplitude": 1e-3, "count": count, "keep": "end"}
    return hypofab.Step(preset="drained_triaxial_compression", axis="z", cycle=cycle)


def test_the_lock_is_released(sand: hypofab.Material) -> None:
    """Two runs without end are inside the library while this thread calls it too; only this thread can end them."""
    test = hypofab.Test(material=sand, state=hypofab.State.isotropic(100, 0.7), steps=[cycles(10_000_000)])
    study = hypofab.Study(test)
    stops = [np.zeros(1, dtype=np.intc) for _ in range(2)]
    begun = threading.Barrier(3)

    def run(stop: np.ndarray) -> hypofab.TestResult:
        begun.wait()
        return study._run(0, stop)

    with ThreadPoolExecutor(2) as executor:
        futures = [executor.submit(run, stop) for stop in stops]
        begun.wait()
        for _ in range(1000):
            hypofab.rate(sand, test.state, [-1, 0, 0, 0, 0, 0])
        assert not any(future.done() for future in futures)
        for stop in stops:
            stop[0] = 1
        results = [future.result() for future in futures]
    assert [result.status for result in results] == [hypofab.Status.INTERRUPTED] * 2


def test_threads_get_the_same_bits(sand: hypofab.Material) -> None:
    start = hypofab.State.isotropic(100, 0.7)
    alone = hypofab.element_test(sand, start, cycles(10)).rows
    with ThreadPoolExecutor(4) as executor:
        for result in executor.map(lambda _: hypofab.element_test(sand, start, cycles(10)), range(8)):
            assert all(np.array_equal(result[name], alone[name], equal_nan=True) for name in alone.dtype.names)


def test_a_signal_ends_a_long_run(sand: hypofab.Material) -> None:
    start = hypofab.State.isotropic(100, 0.7)
    # A shell starts what runs in the background with this signal ignored.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            hypofab.element_test(sand, start, cycles(10_000_000))
    finally:
        timer.join()
        signal.signal(signal.SIGINT, before)


def test_steps_have_every_key_of_decks() -> None:
    """But parameters of presets, which the library knows."""
    keys = set(signature(hypofab.Step).parameters) - {"more", "parameters"}
    deck = mapping()
    deck["tests"][0]["steps"] = [{"no_such_key": 1}]
    with pytest.raises(hypofab.InputError, match="no_such_key: unknown key, expected one of") as bad:
        hypofab.Study(deck)
    known = set(str(bad.value).split("expected one of ")[1].split(", "))
    frame, drive = {"axis", "normal"}, {"rate", "drive", "lode", "direction", "b", "alpha", "stiffness"}
    assert known - keys == frame | drive | {"p_rate", "q_rate", "b_rate", "alpha_rate"}
    assert keys <= known
