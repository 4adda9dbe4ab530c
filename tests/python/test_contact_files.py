"""Contact files through Python: what the libraries of HDF5, NumPy and VTK write, converted and read by the program."""

import gzip
import json
import os
import subprocess
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest

from hypofab.__main__ import main
from hypofab.fabric.contact_files import ContactFileError, convert

dask = pytest.importorskip("dask", reason="dask is missing: python/requirements-test.txt")
h5py = pytest.importorskip("h5py", reason="h5py is missing: python/requirements-contacts.txt")
pytest.importorskip("vtkmodules", reason="vtk is missing: python/requirements-contacts.txt")

PROGRAM = os.environ.get("HYPOFAB_PROGRAM")
DEM = Path(__file__).parents[1] / "data" / "dem"
needs_program = pytest.mark.skipif(PROGRAM is None, reason="HYPOFAB_PROGRAM does not name the program")


def hypofab(*arguments: str | Path) -> dict:
    """What a command of the program prints as JSON."""
    run = subprocess.run([PROGRAM, *map(str, arguments), "--json"], capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    return json.loads(run.stdout)


@pytest.fixture(scope="module")
def table() -> np.ndarray:
    """The columns of YADE's small sample: ids, image, normal, branch, normal and shear force, overlap, point."""
    with gzip.open(DEM / "small_contacts.txt.gz", "rt") as file:
        return np.loadtxt(file)


@pytest.fixture(scope="module")
def arrays(table: np.ndarray) -> dict[str, np.ndarray]:
    return {
        "id1": table[:, 0].astype(np.int32),
        "id2": table[:, 1],
        "cellDist": table[:, 2:5],
        "normal": table[:, 5:8],
        "branch": table[:, 8:11],
        "fn": table[:, 11:14],
        "fs": table[:, 14:17],
    }


def check(path: Path) -> None:
    """The program finds in a converted file what it finds in YADE's table, bit for bit."""
    volume = "2.2225e-7"
    expected = hypofab("describe", DEM / "small_contacts.txt.gz", "--volume", volume)
    found = hypofab("describe", path, "--volume", volume)
    for key in ("contacts", "particles", "fabric", "anisotropy", "stress", "mean_branch_length"):
        assert found[key] == expected[key], key


def write_hdf5(path: Path, arrays: Mapping[str, np.ndarray]) -> None:
    with h5py.File(path, "w") as file:
        group = file.create_group("step/contacts")
        for name, array in arrays.items():
            group.create_dataset(name, data=array, compression="gzip" if name == "normal" else None)


@needs_program
def test_hdf5(tmp_path: Path, arrays: dict[str, np.ndarray]) -> None:
    write_hdf5(tmp_path / "dem.h5", arrays)
    assert convert(tmp_path / "dem.h5", tmp_path / "dem.npy", "step/contacts") == 590
    check(tmp_path / "dem.npy")
    with pytest.raises(ContactFileError, match="no datasets in /; its groups: step"):
        convert(tmp_path / "dem.h5", tmp_path / "none.npy")
    assert not (tmp_path / "none.npy").exists()


@needs_program
def test_hdf5_records(tmp_path: Path, arrays: dict[str, np.ndarray]) -> None:
    kinds = [("id1", ">i4"), ("id2", "<f4"), ("cellDist", "i1", 3)]
    records = np.zeros(590, dtype=[*kinds, *((name, "<f8", 3) for name in ("normal", "branch", "fn", "fs"))])
    for name, array in arrays.items():
        records[name] = array
    with h5py.File(tmp_path / "records.hdf5", "w") as file:
        file["contacts"] = records
    convert(tmp_path / "records.hdf5", tmp_path / "records.npy", "contacts")
    check(tmp_path / "records.npy")
    np.save(tmp_path / "as_is.npy", records)
    convert(tmp_path / "as_is.npy", tmp_path / "records.npy")
    check(tmp_path / "records.npy")


@needs_program
def test_npz(tmp_path: Path, arrays: dict[str, np.ndarray]) -> None:
    np.savez_compressed(tmp_path / "dem.npz", **arrays)
    assert main(["contacts", str(tmp_path / "dem.npz"), str(tmp_path / "dem.npy")]) == 0
    check(tmp_path / "dem.npy")


@needs_program
def test_table_without_names(tmp_path: Path, table: np.ndarray) -> None:
    np.save(tmp_path / "plain.npy", np.asfortranarray(table[:, [0, 1, 5, 6, 7]]))
    convert(tmp_path / "plain.npy", tmp_path / "named.npy", "id1,id2,nx,ny,nz")
    expected = hypofab("fabric", DEM / "small_contacts.txt.gz")
    assert hypofab("fabric", tmp_path / "named.npy")["fabric"] == expected["fabric"]
    with pytest.raises(ContactFileError, match="5 columns without names"):
        convert(tmp_path / "plain.npy", tmp_path / "named.npy")


@needs_program
def test_program_reads_what_numpy_writes(tmp_path: Path, table: np.ndarray) -> None:
    expected = hypofab("fabric", DEM / "small_contacts.txt.gz")
    kinds = [("id1", "u4"), ("id2", "i2"), ("nx", "f8"), ("ny", "f8"), ("nz", "f8")]
    records = np.zeros(590, dtype=np.dtype(kinds, align=True))  # with two bytes of padding
    for name, column in zip(records.dtype.names, (0, 1, 5, 6, 7), strict=True):
        records[name] = table[:, column]
    np.save(tmp_path / "records.npy", records)
    assert hypofab("fabric", tmp_path / "records.npy")["fabric"] == expected["fabric"]
    np.save(tmp_path / "table.npy", table)
    columns = ("--id1", "1", "--id2", "2", "--nx", "6", "--ny", "7", "--nz", "8")
    assert hypofab("fabric", tmp_path / "table.npy", *columns)["fabric"] == expected["fabric"]
    np.save(tmp_path / "single.npy", table.astype(np.float32))
    assert hypofab("fabric", tmp_path / "single.npy", *columns)["fabric"] == pytest.approx(expected["fabric"], abs=1e-7)


@needs_program
def test_normals_in_the_order_of_spam(tmp_path: Path, table: np.ndarray) -> None:
    np.save(tmp_path / "spam.npy", np.ascontiguousarray(table[:, [0, 1, 7, 6, 5]]))
    np.savetxt(tmp_path / "spam.txt", table[:, [0, 1, 7, 6, 5]])
    expected = hypofab("fabric", DEM / "small_contacts.txt.gz")["fabric"]
    for name in ("spam.npy", "spam.txt"):
        assert hypofab("fabric", tmp_path / name, "--file-format", "spam")["fabric"] == expected


@needs_program
def test_vtk_xml(tmp_path: Path, arrays: dict[str, np.ndarray]) -> None:
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

    points, lines, data = vtkPoints(), vtkCellArray(), vtkPolyData()
    points.SetDataTypeToDouble()
    for branch in arrays["branch"]:
        lines.InsertNextCell(2)
        for end in (np.zeros(3), branch):
            lines.InsertCellPoint(points.InsertNextPoint(end))
    data.SetPoints(points)
    data.SetLines(lines)
    for name in ("id1", "id2", "cellDist", "normal", "fn", "fs"):
        values = numpy_to_vtk(np.ascontiguousarray(arrays[name]), deep=True)
        values.SetName(name)
        data.GetCellData().AddArray(values)
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(str(tmp_path / "dem.vtp"))
    writer.SetInputData(data)
    assert writer.Write() == 1
    assert convert(tmp_path / "dem.vtp", tmp_path / "dem.npy") == 590
    check(tmp_path / "dem.npy")


def test_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = tmp_path / "out.npy"
    (tmp_path / "ascii.vtp").write_bytes(gzip.decompress((DEM / "small_recorder_ascii.vtp.gz").read_bytes()))
    with pytest.raises(ContactFileError, match=r"VTKExporter\.exportInteractions"):
        convert(tmp_path / "ascii.vtp", target)
    np.savez(tmp_path / "short.npz", id1=[1, 2], nx=[1.0])
    with pytest.raises(ContactFileError, match=r"unequal length \(id1 2, nx 1\)"):
        convert(tmp_path / "short.npz", target)
    np.savez(tmp_path / "half.npz", id1=[1, 2.5], nx=[1.0, 0.0])
    with pytest.raises(ContactFileError, match=r"contact 2: id1 is 2\.5; expected a whole number"):
        convert(tmp_path / "half.npz", target)
    (tmp_path / "broken.h5").write_bytes(b"no HDF5")
    assert main(["contacts", str(tmp_path / "broken.h5"), str(target)]) == 2
    assert "broken.h5" in capsys.readouterr().err
    with pytest.raises(ContactFileError, match=r"an ending of '\.xls'"):
        convert(tmp_path / "a.xls", target)
    assert not list(tmp_path.glob("*out.npy*"))


@needs_program
def test_ten_parts_through_dask(tmp_path: Path) -> None:
    """Ten parts, summed as Dask's tasks and merged in a tree, are the whole: equal bits."""
    source = DEM.parents[2] / "examples" / "data" / "iso_3000_contacts.txt.gz"
    particles = source.with_name("iso_3000_particles.txt.gz")
    lines = gzip.decompress(source.read_bytes()).decode().splitlines(keepends=True)
    header = [line for line in lines if line.startswith("#")][-1]
    rows = [line for line in lines if not line.startswith("#")]

    @dask.delayed
    def part(number: int) -> Path:
        path = tmp_path / f"{number}.txt"
        path.write_text(header + "".join(rows[number::10]))
        hypofab("fabric", path, "--particles", particles, "--partial", path.with_suffix(".part"))
        return path.with_suffix(".part")

    @dask.delayed
    def merged(first: Path, *others: Path) -> Path:
        target = first.with_suffix(".merged")
        hypofab("merge", first, *others, "--partial", target)
        return target

    parts = [part(number) for number in range(10)]
    tree = merged(merged(*parts[5:]), merged(*parts[:2]), *parts[2:5])
    (result,) = dask.compute(tree, scheduler="threads")
    found, whole = hypofab("merge", result), hypofab("fabric", source, "--particles", particles)
    assert found["contacts"] == 5961
    assert found["reading"]["listed"] == 5961
    assert found == {key: whole[key] for key in found}
