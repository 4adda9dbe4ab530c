"""Ten million contacts from a text file of about 1 GB and from a NumPy array, beside pyarrow's CSV reader.

    pip install -r python/requirements-bench.txt
    python bench/bench_reading.py build [CONTACTS]

The files are made in a temporary folder (TMPDIR, 1.6 GB) and deleted. Times are wall-clock, the best of three runs of a
process of its own, files in the page cache; memory is the largest resident set of the process.
"""

import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PYARROW = """
import sys
from pyarrow import csv
options = csv.ReadOptions(skip_rows=1, autogenerate_column_names=True)
table = csv.read_csv(sys.argv[1], read_options=options, parse_options=csv.ParseOptions(delimiter=" "))
print(table.num_rows)
"""


def measure(command: list[str]) -> tuple[float, float]:
    """Seconds and MiB of the best of three runs."""
    best = (float("inf"), 0.0)
    for _ in range(3):
        start = time.perf_counter()
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        if status:
            raise SystemExit(f"{command[0]} failed")
        best = min(best, (time.perf_counter() - start, usage.ru_maxrss / 1024))
    return best


def main() -> None:
    """Write the files, read them, print a table."""
    build = Path(sys.argv[1])
    contacts = int(sys.argv[2]) if len(sys.argv) > 2 else 10_000_000
    program = str(build / "cli" / "hypofab")
    with tempfile.TemporaryDirectory() as folder:
        text, array = f"{folder}/contacts.txt", f"{folder}/contacts.npy"
        subprocess.run([build / "bench" / "bench_contacts", "write", str(contacts), text, array], check=True)
        runs = {
            "hypofab fabric, text": (text, [program, "fabric", text]),
            "  without looking for duplicates": (text, [program, "fabric", text, "--duplicates", "keep"]),
            "  with one parsing thread": (text, [program, "fabric", text, "--threads", "1"]),
            "hypofab fabric, .npy": (array, [program, "fabric", array]),
            "  without looking for duplicates ": (array, [program, "fabric", array, "--duplicates", "keep"]),
            "pyarrow.csv.read_csv, text": (text, [sys.executable, "-c", PYARROW, text]),
            "cat > /dev/null, text": (text, ["cat", text]),
        }
        print(f"{contacts} contacts, load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
        for name, (path, command) in runs.items():
            seconds, mebibytes = measure(command)
            rate = Path(path).stat().st_size / 1e6 / seconds
            print(f"{name:36s} {seconds:7.2f} s {rate:9.0f} MB/s {mebibytes:8.0f} MiB", flush=True)
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f"{'processor time of everything':36s} {children.ru_utime + children.ru_stime:7.2f} s")


if __name__ == "__main__":
    main()
