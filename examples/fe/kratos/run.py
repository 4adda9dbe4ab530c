"""Run a Kratos GeoMechanics parameter file and write what the first point of the first element sees, step by step.

python run.py drained_triaxial.json [element_test.csv]

The parameter file alone is enough for `python -m KratosMultiphysics.GeoMechanicsApplication.geomechanics_analysis`;
this script only adds the table: time, number of tries (cycles) and Newton iterations of the step, strain (engineering
shear) and stress, both xx yy zz xy yz xz (xx yy zz xy in plane strain), the UMAT's STATEV, and the force on the group
of nodes named Footing if there is one.
"""

import csv
import sys
from pathlib import Path

import KratosMultiphysics as Kratos
from KratosMultiphysics.GeoMechanicsApplication.geomechanics_analysis import GeoMechanicsAnalysis


class RecordedAnalysis(GeoMechanicsAnalysis):
    """An analysis that keeps a row per step."""

    def __init__(self, model: Kratos.Model, parameters: Kratos.Parameters) -> None:
        """As of the base class; rows starts empty."""
        super().__init__(model, parameters)
        self.rows: list[dict[str, float]] = []

    def FinalizeSolutionStep(self) -> None:
        """Add the row of the step that converged."""
        super().FinalizeSolutionStep()
        part = self.model["PorousDomain"]
        info = part.ProcessInfo
        element = next(iter(part.Elements))

        def at_first_point(variable: object) -> object:
            return element.CalculateOnIntegrationPoints(variable, info)[0]

        row = {
            "time": info[Kratos.TIME],
            "cycles": info[Kratos.NUMBER_OF_CYCLES],
            "iterations": info[Kratos.NL_ITERATION_NUMBER],
        }
        strain = at_first_point(Kratos.KratosGlobals.GetVariable("ENGINEERING_STRAIN_VECTOR"))
        stress = at_first_point(Kratos.CAUCHY_STRESS_VECTOR)
        for axes, gamma, sigma in zip(("xx", "yy", "zz", "xy", "yz", "xz"), strain, stress, strict=False):
            row[f"eps_{axes}" if axes[0] == axes[1] else f"gamma_{axes}"] = gamma
            row[f"sig_{axes}"] = sigma
        for i in range(1, 14):
            row[f"statev_{i}"] = at_first_point(Kratos.KratosGlobals.GetVariable(f"STATE_VARIABLE_{i}"))
        if part.HasSubModelPart("Footing"):
            nodes = part.GetSubModelPart("Footing").Nodes
            row["footing_force"] = -sum(node.GetSolutionStepValue(Kratos.REACTION_Y) for node in nodes)
        self.rows.append(row)


def write_rows(rows: list[dict[str, float]], path: str) -> None:
    """Write rows as comma-separated values with a header."""
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)


def main(arguments: list[str]) -> None:
    """Run the file named first; write the rows to the file named second, by default <problem_name>.csv."""
    parameters = Kratos.Parameters(Path(arguments[0]).read_text())
    table = arguments[1] if len(arguments) > 1 else parameters["problem_data"]["problem_name"].GetString() + ".csv"
    analysis = RecordedAnalysis(Kratos.Model(), parameters)
    analysis.Run()
    write_rows(analysis.rows, table)


if __name__ == "__main__":
    main(sys.argv[1:])
