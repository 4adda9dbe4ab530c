"""Element tests: decks from files, mappings or objects, and their runs."""
