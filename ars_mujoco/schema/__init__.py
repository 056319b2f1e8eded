"""Schema: how things are declared, written by users, and read."""
