"""Commands of the program `hypofab` that are Python's."""
