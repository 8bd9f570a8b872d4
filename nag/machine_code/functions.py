"""Python functions translated to LLVM's language: statements, and whole functions.

The package says which part of Python that is. Whatever else there is in a function is refused.
"""

from __future__ import annotations

import ast
import inspect
import textwrap
from types import FunctionType
from typing import Any, get_type_hints

from llvmlite import ir

from nag.machine_code.control_register import call_flushing
from nag.machine_code.expressions import Expressions
from nag.machine_code.processor import ENTRY, processor
from nag.machine_code.records import INT, NONE, Constant, Record, Type, constant_type, record
from nag.machine_code.values import (
    BYTE,
    WORD,
    KernelError,
    LocatedError,
    Value,
    constant,
    convert,
    llvm_type,
)

# Functions of at most so many syntax nodes are put in where they are called, unless with those that
# are put into them there are so many.
SMALL, LARGE = 130, 2000
# The kernel itself, which has no result and is not put into what is called from C.
KERNEL = "kernel"


class Module:
    """An LLVM module with one function to be called from C, `ENTRY`, and all those that it needs.

    Args:
        function: the Python function that the former is.
        constants: its first arguments, see `nag.machine_code.kernel.Kernel`.
        triple: LLVM's name of the kind of system that it is for; by default of this one.

    Raises:
        KernelError: if anything in a function is not translated; it says in which file and line.
    """

    def __init__(
        self,
        function: FunctionType,
        constants: tuple[Any, ...] = (),
        triple: str | None = None,
    ) -> None:
        self.ir = ir.Module(function.__name__)
        self.ir.triple = ""
        self.constant_memory = self.ir.add_metadata([])
        self._known: dict[tuple[Any, ...], _Body | None] = {}
        hints = get_type_hints(function)
        names = function.__code__.co_varnames[len(constants) : function.__code__.co_argcount]
        kinds: list[Type] = [constant_type(value) for value in constants]
        try:
            kinds += [record(hints[name]) for name in names if name in hints]
        except TypeError as error:
            raise _refuse_function(function, str(error)) from None
        body = _Body(self, function, tuple(kinds), KERNEL)
        self._define_entry(body.function, processor().triple if triple is None else triple)

    def _define_entry(self, body: Any, triple: str) -> None:
        """What is called from C: the kernel, for which numbers below the normal ones are zero."""
        entry = ir.Function(self.ir, body.function_type, ENTRY)
        entry.attributes.add("nounwind")
        builder = ir.IRBuilder(entry.append_basic_block())
        call_flushing(builder, triple, body, entry.args)
        builder.ret_void()

    def translated(self, function: FunctionType, kinds: tuple[Type, ...]) -> _Body:
        """The function for these types of arguments."""
        key = (function, *kinds)
        if key not in self._known:
            self._known[key] = None
            name = f"{function.__name__}.{len(self._known)}"
            self._known[key] = _Body(self, function, kinds, name)
        known = self._known[key]
        if known is None:
            raise KernelError(f"{function.__name__} calls itself")
        return known


def _refuse_function(function: FunctionType, message: str) -> LocatedError:
    code = function.__code__
    return LocatedError(f"{code.co_filename}:{code.co_firstlineno}: {message}")


def _syntax(function: FunctionType) -> ast.FunctionDef:
    """Syntax of a function that is nothing but its own statements and its module's names."""
    name = function.__name__
    try:
        tree = ast.parse(textwrap.dedent(inspect.getsource(function))).body[0]
    except (OSError, SyntaxError, IndexError):
        raise _refuse_function(function, f"{name} has no source of its own") from None
    if not isinstance(tree, ast.FunctionDef):
        raise _refuse_function(function, f"{name} is no function made by def")
    if tree.decorator_list or hasattr(function, "__wrapped__"):
        raise _refuse_function(function, f"{name} is decorated")
    if function.__closure__:
        names = ", ".join(function.__code__.co_freevars)
        raise _refuse_function(function, f"{name} needs {names} of the function round it")
    given = tree.args
    if given.posonlyargs or given.kwonlyargs or given.vararg or given.kwarg or given.defaults:
        raise _refuse_function(function, f"{name} has arguments other than plain ones")
    return tree


class _Body(Expressions):
    """The translation of one function; ``result`` is the type of what it returns."""

    def __init__(
        self, module: Module, function: FunctionType, kinds: tuple[Type, ...], name: str
    ) -> None:
        tree = _syntax(function)
        names = [a.arg for a in tree.args.args]
        if len(names) != len(kinds):
            what = "arguments with types" if name == KERNEL else "arguments"
            message = f"{function.__name__} takes {len(names)} {what}, not {len(kinds)}"
            raise _refuse_function(function, message)
        nodes = list(ast.walk(tree))
        results = any(isinstance(n, ast.Return) and n.value for n in nodes)
        self.returns = results and name != KERNEL
        given = [llvm_type(kind) for kind in kinds if not isinstance(kind, Constant)]
        # A result goes where the first argument points, as its type is known last.
        if self.returns:
            given.insert(0, BYTE.as_pointer())
        given.append(WORD.as_pointer())
        code = ir.Function(module.ir, ir.FunctionType(ir.VoidType(), given), name)
        code.attributes.add("nounwind")
        code.linkage = "internal"
        if name == KERNEL:
            code.attributes.add("noinline")
        super().__init__(module, function, code)
        self.result: Type = NONE
        # Where each loop goes on and where it ends; what has a value at each break of it.
        self.loops: list[tuple[Any, Any, list[set[str]]]] = []
        start = self.builder.block
        arguments = iter(code.args[self.returns :])
        for parameter, kind in zip(names, kinds, strict=True):
            argument = None if isinstance(kind, Constant) else next(arguments)
            if isinstance(kind, Record):
                argument.add_attribute("noalias")
                argument.attributes.dereferenceable = 8 * len(kind.fields)
                argument.attributes.align = 8
            self._set(parameter, Value(kind, argument))
        code.args[-1].add_attribute("noalias")
        self._suite(tree.body)
        if not self.builder.block.is_terminated:
            if self.returns:
                raise self._fail(tree, f"{function.__name__} may end without a result")
            self.builder.ret_void()
        self.reserve.branch(start)
        # Those of the functions that are put in have been added on the way.
        self.size += len(nodes)
        self.is_put_in = name != KERNEL and len(nodes) <= SMALL and self.size <= LARGE

    def _suite(self, statements: list[ast.stmt]) -> None:
        """Translate statements, up to one after which nothing is left to do in this case."""
        for statement in statements:
            if self.builder.block.is_terminated:
                raise self._fail(statement, "nothing leads here")
            method = getattr(self, f"_do_{type(statement).__name__}", None)
            if method is None:
                raise self._fail(statement, f"{type(statement).__name__} is not translated")
            try:
                if method(statement):
                    return
            except LocatedError:
                raise
            except KernelError as error:
                raise self._fail(statement, str(error)) from None

    def _do_Pass(self, node: ast.Pass) -> None:
        pass

    def _do_Expr(self, node: ast.Expr) -> None:
        if not isinstance(node.value, ast.Constant):
            self._value(node.value, allow_none=True)

    def _do_Assign(self, node: ast.Assign) -> None:
        value = self._value(node.value)
        for target in node.targets:
            self._assign(target, value)

    def _do_AugAssign(self, node: ast.AugAssign) -> None:
        if isinstance(node.target, ast.Subscript):
            place, kind = self._place(node.target)
            old = self._load(place, kind)
            self._store(place, kind, self._operated(node, old, self._value(node.value)))
        elif isinstance(node.target, ast.Name):
            old = self._of_Name(node.target)
            self._assign(node.target, self._operated(node, old, self._value(node.value)))
        else:
            raise KernelError(f"{ast.unparse(node.target)} cannot be changed")

    def _do_Return(self, node: ast.Return) -> None:
        if node.value is None and self.returns:
            raise KernelError("a result is missing")
        if node.value is not None and not self.returns:
            raise KernelError("a kernel returns nothing")
        if node.value is not None:
            value = self._value(node.value)
            if self.result is NONE:
                self.result = value.type
            value = convert(self.builder, value, self.result)
            pointer = llvm_type(self.result).as_pointer()
            self.builder.store(value.code, self.builder.bitcast(self.function.args[0], pointer))
        self.builder.ret_void()

    def _do_If(self, node: ast.If) -> bool:
        """Whether it is known which way leads on, and that nothing follows there."""
        known = self._fixed(node.test)
        if known is not None:
            self._suite(node.body if known else node.orelse)
            return bool(self.builder.block.is_terminated)
        yes, no, after = (self.function.append_basic_block() for _ in range(3))
        self._branch(node.test, yes, no)
        before, ends = self.assigned, []
        for block, suite in ((yes, node.body), (no, node.orelse)):
            self.builder.position_at_end(block)
            self.assigned = set(before)
            self._suite(suite)
            if not self.builder.block.is_terminated:
                self.builder.branch(after)
                ends.append(self.assigned)
        self._go_on(after, ends)
        return False

    def _go_on(self, block: Any, ends: list[set[str]]) -> None:
        """Go on where several ways end, if any; what has a value has one on each of them."""
        self.builder.position_at_end(block)
        if ends:
            self.assigned = set.intersection(*ends)
        else:
            self.builder.unreachable()

    def _do_While(self, node: ast.While) -> None:
        if node.orelse:
            raise self._fail(node.orelse[0], "else of a loop is not translated")
        head, body, after = (self.function.append_basic_block() for _ in range(3))
        self.builder.branch(head)
        self.builder.position_at_end(head)
        endless = isinstance(node.test, ast.Constant) and node.test.value is True
        if endless:
            self.builder.branch(body)
        else:
            self._branch(node.test, body, after)
        ends = [] if endless else [self.assigned]
        self.builder.position_at_end(body)
        self._go_on(after, ends + self._loop(node.body, head, after))

    def _do_For(self, node: ast.For) -> None:
        if node.orelse:
            raise self._fail(node.orelse[0], "else of a loop is not translated")
        first, stop, step = self._range(node.iter)
        counter = self.reserve.alloca(WORD)
        self.builder.store(first, counter)
        head, body, following, after = (self.function.append_basic_block() for _ in range(4))
        self.builder.branch(head)
        self.builder.position_at_end(head)
        now = self.builder.load(counter)
        more = self.builder.icmp_signed("<" if step.constant > 0 else ">", now, stop)
        self.builder.cbranch(more, body, after)
        self.builder.position_at_end(body)
        before = set(self.assigned)
        self._assign(node.target, Value(INT, self.builder.load(counter)))
        ends = self._loop(node.body, following, after)
        self.builder.position_at_end(following)
        self.builder.store(self.builder.add(self.builder.load(counter), step), counter)
        self.builder.branch(head)
        self._go_on(after, [before, *ends])

    def _range(self, call: ast.expr) -> tuple[Any, Any, ir.Constant]:
        """First number, end and step of a range."""
        if not isinstance(call, ast.Call) or self._static(call.func) is not range or call.keywords:
            raise KernelError("for needs range(..)")
        bounds = [self._value(a) for a in call.args]
        if not 1 <= len(bounds) <= 3:
            raise KernelError(f"range takes 1 to 3 arguments, not {len(bounds)}")
        if len(bounds) == 1:
            bounds.insert(0, constant(0))
        step = bounds[2] if len(bounds) == 3 else constant(1)
        if step.type != INT or not isinstance(step.code, ir.Constant) or not step.code.constant:
            raise KernelError("the step of a range must be a constant, and not zero")
        first, stop = (convert(self.builder, b, INT).code for b in bounds[:2])
        return first, stop, step.code

    def _loop(self, suite: list[ast.stmt], following: Any, after: Any) -> list[set[str]]:
        """What is repeated; returns what has a value at each break."""
        self.loops.append((following, after, []))
        self.assigned = set(self.assigned)
        self._suite(suite)
        if not self.builder.block.is_terminated:
            self.builder.branch(following)
        return self.loops.pop()[2]

    def _do_Break(self, node: ast.Break) -> None:
        _, after, ends = self.loops[-1]
        ends.append(self.assigned)
        self.builder.branch(after)

    def _do_Continue(self, node: ast.Continue) -> None:
        self.builder.branch(self.loops[-1][0])
