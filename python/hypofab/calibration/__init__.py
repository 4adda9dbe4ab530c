"""Material parameters from laboratory tests."""
