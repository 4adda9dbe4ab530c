"""Run an element test of ../kratos through the interface of PLAXIS' user-defined soil models, and write its table.

python run_udsm.py drained_triaxial.json [table.csv]
python run_udsm.py oedometer.json [table.csv]
python run_udsm.py biaxial.json [table.csv]

The parameter files and meshes are those of ../kratos; what differs is the material, of the same name here. The table is
described in ../kratos/run.py; its columns statev_1 to statev_13 are the state variables of docs/plaxis.md.
"""

import sys
from pathlib import Path

import KratosMultiphysics as Kratos

HERE = Path(__file__).resolve().parent
KRATOS = HERE.parent / "kratos"
sys.path.insert(0, str(KRATOS))

from run import RecordedAnalysis, write_rows  # noqa: E402


def main(arguments: list[str]) -> None:
    """Run the file of ../kratos named first; write the rows to the file named second, by default <problem_name>.csv."""
    parameters = Kratos.Parameters((KRATOS / arguments[0]).read_text())
    solver = parameters["solver_settings"]
    mesh = solver["model_import_settings"]["input_filename"]
    mesh.SetString(str(KRATOS / mesh.GetString()))
    material = solver["material_import_settings"]["materials_filename"]
    material.SetString(str(HERE / material.GetString()))
    table = arguments[1] if len(arguments) > 1 else parameters["problem_data"]["problem_name"].GetString() + ".csv"
    analysis = RecordedAnalysis(Kratos.Model(), parameters)
    analysis.Run()
    write_rows(analysis.rows, table)


if __name__ == "__main__":
    main(sys.argv[1:])
