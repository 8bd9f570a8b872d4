"""Python functions of numbers, pointers and vector registers, compiled to machine code.

Numba compiles all of Python, and costs for it: half a minute for the tracker's kernels, and half a
second for every later run that loads them. The kernels use numbers, arrays and loops alone; for
these few constructs LLVM is called here directly, at a tenth of both. A kernel is also a function
of Python, and `plain` runs it as such, with every place in memory checked.

What is translated is this; whatever else a function has in it is refused, with file and line.

Functions
    Plain ``def`` with plain arguments: no defaults, decorators, nor variables of a function round
    it. The kernel itself takes constants (below), then records (see `records`), and returns
    nothing. Functions that it calls are translated for the types of their arguments, and return one
    type on all ways, or nothing on any. None calls itself, but for other types: for shorter tuples.
Constants
    Objects that are known when the kernel is compiled, of whatever class, as an arithmetic is.
    Their attributes are numbers and other such objects; their methods are translated for each.
Types
    ``bool``, ``int`` (64 bits, wraps round), ``float``, ``complex``, lanes (see `lanes`), tuples of
    these, arrays of a record, records, and constants. A variable keeps the type that it gets first;
    each of the first four converts to the later ones. It may be read only where every way that
    leads there gave it a value. Names of a module, and attributes of modules, must stay what they
    are.
Statements
    Assignments to names, array entries and tuples of these, also in place; ``if``; ``while``;
    ``for .. in range(..)`` with a constant step, none with an ``else``; ``break``, ``continue``,
    ``pass``, ``return``; calls. None that nothing leads to.
Expressions
    Numbers and names; fields of records; ``.real, .imag, .conjugate()`` of complex numbers;
    ``a[k]`` with a whole number, in a tuple a constant, there ``a[i:j]`` as well; tuples, ``+`` of
    two, and ``len``; ``+ - * /`` of numbers and of lanes, ``// %`` of whole numbers, ``<< >>`` by a
    constant, ``** 2``, ``**`` of a real number and a double; comparisons of numbers, one after the
    other until one does not hold; ``in`` a tuple that is written out; ``not``, and ``and, or`` of
    conditions (where a number is wanted, of ``bool`` alone); ``.. if .. else ..``; calls of such
    functions and of `operations.OPERATIONS`. Sums, differences and comparisons of whole numbers
    that are constants, as lengths of tuples are, are constants; a condition that is one decides
    which way is translated at all.
Errors
    Dividing a whole number by zero raises `ZeroDivisionError`. Nothing else raises: divisions of
    doubles by zero, roots and powers without a real value give an infinity or NaN; whole numbers
    wrap round at 64 bits; a double becomes the nearest ``int`` towards zero, NaN 0. Places in
    memory are not checked, and must not be negative: `plain` finds those that are outside.
    Numbers of more than 53 bits are rounded where they meet doubles. Doubles below the normal ones
    (2.2e-308) are zero, see `control_register`.

Read top-down: `kernel`, then `functions`, `expressions` on `values` and `failures`, `operators` and
`operations`, `control_register`, then `processor`.
"""
