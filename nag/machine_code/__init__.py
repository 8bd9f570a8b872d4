"""Python functions of numbers, pointers and vector registers, compiled to machine code."""
