"""Studies: from users' files to runs that are measured against each other."""
