"""Linear theory of the actuator on the bench, taken from the running code (paper sections 4.2.2 and 5).

Each analysis is a module with `compute(loop)`, numbers that JSON can hold, `draw(result)`, its figure, and
`headline(result)`, what a table says of it. They need the extra `analysis` (python-control, matplotlib, scipy).
"""
