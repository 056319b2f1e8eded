"""Bridge: mjData and back."""
