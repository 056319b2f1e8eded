"""Excitations: what the bench is driven with, the bar's command and the travel of its ends."""
