"""Python functions of numbers, pointers and vector registers, compiled to machine code.

Numba compiles all of Python, and costs for it: half a minute for the tracker's kernels, and half a
second for every later run that loads them. The kernels use numbers, arrays and loops alone; for
these few constructs LLVM is called here directly, at a tenth of both.
"""
