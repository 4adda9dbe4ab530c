"""What the scripts of this folder share: options, material, boundaries, servo control, run folders and export."""
