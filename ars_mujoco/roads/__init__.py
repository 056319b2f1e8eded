"""Roads: what the wheels roll on."""
