"""Write a change of project files, by which they start with the memory of a DEM sample.

python delta_patch.py DELTA.json PATCH.xml

DELTA.json is what `hypofab delta ... --json` printed. OpenGeoSys applies the change: ogs -p PATCH.xml footing.prj
"""

import json
import math
import sys
from pathlib import Path


def main(source: Path, target: Path) -> None:
    """Replace the values of the parameter delta by those of a plane strain problem in the x-y plane."""
    xx, yy, zz, xy, _, _ = json.loads(source.read_text())["delta"]
    # Plane strain has no place for xz and yz. The behaviour takes shear times sqrt(2).
    values = f"{xx!r} {yy!r} {zz!r} {math.sqrt(2) * xy!r}"
    target.write_text(
        "<OpenGeoSysProjectDiff>\n"
        f"  <replace sel=\"/*/parameters/parameter[name='delta']/values/text()\">{values}</replace>\n"
        "</OpenGeoSysProjectDiff>\n"
    )


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
