"""Control of the stabilizer: reference, outer and inner loop, each usable alone; floats in, floats out."""
