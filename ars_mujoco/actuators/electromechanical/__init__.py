"""Electromechanical: a motor and a planetary gear between the halves of each bar, on one electric supply."""
