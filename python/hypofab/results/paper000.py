"""Directional stiffness as published in paper 000, Table 4, and by exact integration of the same equations.

Secant stiffness G = q/eps_q at eps_q = 0.1 % [kPa] (paper 000, Eq. 8) of a sample with vertical (A) and isotropic (I)
fabric, loaded along the vertical (0) and a horizontal (90) axis.
"""

ELEMENT_TEST = {"A-0": 114423.0, "A-90": 53247.0, "I-0": 57931.0, "I-90": 57931.0}
"""Table 4, "G (Element test)", computed with Tochnog."""

DEM = {"A-0": 28327.0, "A-90": 12707.0, "I-0": 26657.0, "I-90": 26203.0}
"""Table 4, "G (DEM)", computed with YADE; the sand of the element tests was not calibrated to these spheres."""

EXACT = {"A-0": 114796.0, "A-90": 53117.0, "I-0": 58069.0, "I-90": 58069.0}
"""The element tests of Tables 2 and 3, integrated with an error far below the last digit."""
