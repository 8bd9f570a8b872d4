"""Python functions translated to LLVM's language.

A small part of Python: numbers, tuples, pointers and records; assignments, ``if``, ``while``,
``for .. in range(..)`` with a constant step, ``return``; calls of other such functions, which are
translated for the types of their arguments, and of what `nag.machine_code.operations` knows. Names
of the module must stay what they are. A variable keeps the type that it gets first. All parts of a
chain of comparisons are evaluated. Whatever else there is in a function is refused.
"""

from __future__ import annotations

import ast
import inspect
import textwrap
from collections.abc import Mapping
from types import FunctionType, ModuleType
from typing import Any, get_type_hints

from llvmlite import ir

from nag.machine_code import operators
from nag.machine_code.expressions import Expressions
from nag.machine_code.records import INT, NONE, Record, Type, record
from nag.machine_code.values import (
    BYTE,
    WORD,
    KernelError,
    Value,
    constant,
    convert,
    llvm_type,
)

# Functions of at most so many syntax nodes are put in where they are called.
SMALL = 130


class LocatedError(KernelError):
    """A `KernelError` that says where."""


class Module:
    """An LLVM module with one function to be called from C and all those that it needs."""

    def __init__(
        self, function: FunctionType, modules: Mapping[str, ModuleType] | None = None
    ) -> None:
        self.modules = dict(modules or {})
        self.ir = ir.Module(function.__name__)
        self.ir.triple = ""
        self.constant_memory = self.ir.add_metadata([])
        self._known: dict[tuple[Any, ...], tuple[ir.Function, Type] | None] = {}
        hints = get_type_hints(function)
        hints.pop("return", None)
        kinds = tuple(record(hint) for hint in hints.values())
        _Body(self, function, kinds, function.__name__)

    def translated(self, function: FunctionType, kinds: tuple[Type, ...]) -> tuple[Any, Type]:
        """The function for these types of arguments, and the type of its result."""
        key = (function, *kinds)
        if key not in self._known:
            self._known[key] = None
            body = _Body(self, function, kinds, f"{function.__name__}.{len(self._known)}")
            self._known[key] = (body.function, body.result)
        known = self._known[key]
        if known is None:
            raise KernelError(f"{function.__name__} calls itself")
        return known


def _syntax(function: FunctionType) -> ast.FunctionDef:
    tree = ast.parse(textwrap.dedent(inspect.getsource(function))).body[0]
    assert isinstance(tree, ast.FunctionDef)
    return tree


class _Body(Expressions):
    """The translation of one function; ``result`` is the type of what it returns."""

    def __init__(
        self, module: Module, function: FunctionType, kinds: tuple[Type, ...], name: str
    ) -> None:
        tree = _syntax(function)
        names = [a.arg for a in tree.args.args]
        if len(names) != len(kinds):
            raise KernelError(f"{name} takes {len(names)} arguments, not {len(kinds)}")
        nodes = list(ast.walk(tree))
        returns = any(isinstance(n, ast.Return) and n.value for n in nodes)
        given = [llvm_type(kind) for kind in kinds]
        # A result goes where the first argument points, as its type is known last.
        if returns:
            given.insert(0, BYTE.as_pointer())
        code = ir.Function(module.ir, ir.FunctionType(ir.VoidType(), given), name)
        code.attributes.add("nounwind")
        if name != function.__name__:
            code.linkage = "internal"
            if len(nodes) <= SMALL:
                code.attributes.add("alwaysinline")
        super().__init__(module, function, code)
        self.result: Type = NONE
        self.returns = returns
        # Where each loop goes on and where it ends; those ends that a break leads to.
        self.loops: list[tuple[Any, Any]] = []
        self.left: set[str] = set()
        start = self.builder.block
        for argument, parameter, kind in zip(code.args[returns:], names, kinds, strict=True):
            if isinstance(kind, Record):
                argument.add_attribute("noalias")
                argument.attributes.dereferenceable = 8 * len(kind.fields)
                argument.attributes.align = 8
            self._set(parameter, Value(kind, argument))
        self._suite(tree.body)
        if not self.builder.block.is_terminated:
            if returns:
                raise self._fail(tree, f"{name} may end without a result")
            self.builder.ret_void()
        self.reserve.branch(start)

    def _fail(self, node: ast.AST, message: str) -> LocatedError:
        code = self.python.__code__
        line = code.co_firstlineno + getattr(node, "lineno", 1) - 1
        return LocatedError(f"{code.co_filename}:{line}: {message}")

    def _suite(self, statements: list[ast.stmt]) -> None:
        for statement in statements:
            if self.builder.block.is_terminated:
                return
            method = getattr(self, f"_do_{type(statement).__name__}", None)
            if method is None:
                raise self._fail(statement, f"{type(statement).__name__} is not translated")
            try:
                method(statement)
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
            value = operators.binary(self.builder, node.op, old, self._value(node.value))
            self._store(place, kind, value)
        else:
            old = self._value(ast.Name(node.target.id, ast.Load()))
            value = operators.binary(self.builder, node.op, old, self._value(node.value))
            self._assign(node.target, value)

    def _do_Return(self, node: ast.Return) -> None:
        if node.value is None and self.returns:
            raise KernelError("a result is missing")
        if node.value is not None:
            value = self._value(node.value)
            if self.result is NONE:
                self.result = value.type
            value = convert(self.builder, value, self.result)
            pointer = llvm_type(self.result).as_pointer()
            self.builder.store(value.code, self.builder.bitcast(self.function.args[0], pointer))
        self.builder.ret_void()

    def _do_If(self, node: ast.If) -> None:
        yes, no, after = (self.function.append_basic_block() for _ in range(3))
        self._branch(node.test, yes, no)
        reached = False
        for block, suite in ((yes, node.body), (no, node.orelse)):
            self.builder.position_at_end(block)
            self._suite(suite)
            if not self.builder.block.is_terminated:
                self.builder.branch(after)
                reached = True
        self.builder.position_at_end(after)
        if not reached:
            self.builder.unreachable()

    def _do_While(self, node: ast.While) -> None:
        head, body, after = (self.function.append_basic_block() for _ in range(3))
        self.builder.branch(head)
        self.builder.position_at_end(head)
        endless = isinstance(node.test, ast.Constant) and node.test.value is True
        if endless:
            self.builder.branch(body)
        else:
            self._branch(node.test, body, after)
        self._loop(node.body, body, head, after)
        self.builder.position_at_end(after)
        if endless and after.name not in self.left:
            self.builder.unreachable()

    def _do_For(self, node: ast.For) -> None:
        call = node.iter
        if not isinstance(call, ast.Call) or self._static(call.func) is not range:
            raise KernelError("for needs range(..)")
        bounds = [self._value(a) for a in call.args]
        if len(bounds) == 1:
            bounds.insert(0, constant(0))
        step = bounds[2].code if len(bounds) == 3 else ir.Constant(WORD, 1)
        if not isinstance(step, ir.Constant) or not step.constant:
            raise KernelError("the step of a range must be a constant")
        first, stop = (convert(self.builder, b, INT).code for b in bounds[:2])
        counter = self.reserve.alloca(WORD)
        self.builder.store(first, counter)
        head, body, following, after = (self.function.append_basic_block() for _ in range(4))
        self.builder.branch(head)
        self.builder.position_at_end(head)
        now = self.builder.load(counter)
        more = self.builder.icmp_signed("<" if step.constant > 0 else ">", now, stop)
        self.builder.cbranch(more, body, after)
        self.builder.position_at_end(body)
        self._assign(node.target, Value(INT, self.builder.load(counter)))
        self._loop(node.body, self.builder.block, following, after)
        self.builder.position_at_end(following)
        self.builder.store(self.builder.add(self.builder.load(counter), step), counter)
        self.builder.branch(head)
        self.builder.position_at_end(after)

    def _loop(self, suite: list[ast.stmt], body: Any, following: Any, after: Any) -> None:
        self.loops.append((following, after))
        self.builder.position_at_end(body)
        self._suite(suite)
        if not self.builder.block.is_terminated:
            self.builder.branch(following)
        self.loops.pop()

    def _do_Break(self, node: ast.Break) -> None:
        after = self.loops[-1][1]
        self.left.add(after.name)
        self.builder.branch(after)

    def _do_Continue(self, node: ast.Continue) -> None:
        self.builder.branch(self.loops[-1][0])
