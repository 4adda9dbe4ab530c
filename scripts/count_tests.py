"""Print "N passed, N failed" for the JUnit reports of a test run.

Usage: count_tests.py STATUS FOLDER. STATUS is the exit status of the run: a run that failed outside of a test (a build,
the formatting) counts as one failure.
"""

import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path


def main(status: int, folder: Path) -> int:
    """Count the test cases of every report in the folder; the exit status is that of the run, 1 when nothing ran."""
    passed = failed = 0
    for report in sorted(folder.glob("*.xml")):
        for case in ElementTree.parse(report).iter("testcase"):
            if case.find("failure") is not None or case.find("error") is not None:
                failed += 1
            elif case.find("skipped") is None:
                passed += 1
    if status == 0 and passed == 0:
        status = 1
    if status != 0 and failed == 0:
        failed = 1
    print(f"{passed} passed, {failed} failed")
    return status


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]), Path(sys.argv[2])))
