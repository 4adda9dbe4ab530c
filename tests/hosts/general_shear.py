"""Prescribe every node of the cube so that all six strains differ and turn half way; write the table of run.py.

python general_shear.py MATERIALS table.csv     with examples/fe/kratos in PYTHONPATH
"""

import sys
from pathlib import Path

import KratosMultiphysics as Kratos
import run as example
from run import RecordedAnalysis, write_rows

# Displacement gradients of the two halves of the test, per unit of time.
FIRST = ((-3e-3, 7e-4, 5e-4), (9e-4, 1e-3, -6e-4), (2e-4, 2.5e-3, -2e-3))
SECOND = ((2e-3, -1e-3, 4e-4), (-8e-4, -2e-3, 1.5e-3), (1e-3, -5e-4, -1e-3))


class GeneralShear(RecordedAnalysis):
    """Boundary conditions in place of those of the parameter file."""

    def ApplyBoundaryConditions(self) -> None:
        """Fix every node where the displacement gradient puts it."""
        super().ApplyBoundaryConditions()
        part = self.model["PorousDomain"]
        time = part.ProcessInfo[Kratos.TIME]
        first, second = min(time, 0.5), max(time - 0.5, 0.0)
        variables = (Kratos.DISPLACEMENT_X, Kratos.DISPLACEMENT_Y, Kratos.DISPLACEMENT_Z)
        for node in part.Nodes:
            place = (node.X0, node.Y0, node.Z0)
            for variable, row, later in zip(variables, FIRST, SECOND, strict=True):
                gradient = [first * a + second * b for a, b in zip(row, later, strict=True)]
                node.Fix(variable)
                node.SetSolutionStepValue(variable, sum(h * x for h, x in zip(gradient, place, strict=True)))


folder = Path(example.__file__).resolve().parent
parameters = Kratos.Parameters((folder / "oedometer.json").read_text())
solver = parameters["solver_settings"]
solver["model_import_settings"]["input_filename"].SetString(str(folder / "cube"))
solver["material_import_settings"]["materials_filename"].SetString(sys.argv[1])
analysis = GeneralShear(Kratos.Model(), parameters)
analysis.Run()
write_rows(analysis.rows, sys.argv[2])
