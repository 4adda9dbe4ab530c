"""What of a laboratory test is computed: a variant for each sand and each start of delta."""

from dataclasses import dataclass

from hypofab.laboratory.catalogue import LabTest
from hypofab.laboratory.series import Series

STARTS = {
    "mobilised": "along the isotropic (oedometer: axial) compression before the test",
    "zero": "no memory",
    "shearing": "along the strain that the test begins with: the softest answer",
}
"""Starts of the intergranular strain, and what they mean. The first is the one the report judges by."""


@dataclass(frozen=True)
class Variant:
    """A laboratory test as computed."""

    test: LabTest
    sand: str
    start: str
    """Key of STARTS, or "none" for a sand without intergranular strain."""
    void_ratio: float

    @property
    def name(self) -> str:
        """Name of the test in the deck and of its result file."""
        return f"{self.test.name}-{self.sand}-{self.start}-e{self.void_ratio:.4f}"


@dataclass(frozen=True)
class Computed:
    """Result of a variant."""

    variant: Variant
    rows: Series
    status: str
    """What the program says of how it ended."""


def starts_of(test: LabTest) -> tuple[str, ...]:
    """The starts of delta that differ: in an oedometer the compression before is the strain that follows."""
    return tuple(start for start in STARTS if not (test.kind == "oedometer" and start == "shearing"))
