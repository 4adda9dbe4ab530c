"""Sweeps: many runs of a deck or a function, their table, and Sobol indices. docs/sweeps.md."""

from importlib.util import find_spec

_MISSING = [name for name in ("SALib", "pyarrow", "ruamel.yaml", "tqdm") if find_spec(name.split(".")[0]) is None]
if _MISSING:
    raise ImportError(f"sweeps need {', '.join(_MISSING)}; `pip install 'hypofab[sweep]'` installs them")
