"""Expressions of Python translated to LLVM's language, and the memory that they read and write."""

from __future__ import annotations

import ast
import builtins
from collections.abc import Callable
from types import FunctionType, ModuleType
from typing import Any

from llvmlite import ir

from nag.machine_code import operators
from nag.machine_code.operations import OPERATIONS
from nag.machine_code.records import (
    BOOL,
    COMPLEX,
    INT,
    NONE,
    NUMBERS,
    REAL,
    Pointer,
    Record,
    Tuple,
    Type,
    several,
)
from nag.machine_code.values import (
    BIT,
    BYTE,
    WORD,
    KernelError,
    Value,
    constant,
    convert,
    llvm_type,
    parts,
    truth,
)


class Expressions:
    """Variables and expressions of a function that is being translated.

    Variables live in memory that the first block reserves; LLVM makes registers of them. A
    variable keeps the type that it gets first.
    """

    def __init__(self, module: Any, python: FunctionType, function: ir.Function) -> None:
        self.module, self.python, self.function = module, python, function
        self.reserve = ir.IRBuilder(function.append_basic_block("variables"))
        self.builder = ir.IRBuilder(function.append_basic_block("start"))
        self.variables: dict[str, tuple[Type, Any]] = {}
        self.local = set(python.__code__.co_varnames)

    # Variables and memory.

    def _set(self, name: str, value: Value) -> None:
        if value.type is NONE:
            raise KernelError(f"nothing is assigned to {name}")
        if name not in self.variables:
            place = self.reserve.alloca(llvm_type(value.type), name=name)
            self.variables[name] = (value.type, place)
        kind, place = self.variables[name]
        try:
            code = convert(self.builder, value, kind).code
        except KernelError:
            raise KernelError(f"{name} is {kind} and cannot become {value.type}") from None
        self.builder.store(code, place)

    def _assign(self, target: ast.expr, value: Value) -> None:
        if isinstance(target, ast.Name):
            self._set(target.id, value)
        elif isinstance(target, ast.Subscript):
            place, kind = self._place(target)
            self._store(place, kind, value)
        elif isinstance(target, ast.Tuple) and isinstance(value.type, Tuple):
            if len(target.elts) != len(value.type.items):
                raise KernelError(f"{value.type} does not fit {len(target.elts)} targets")
            for k, part in enumerate(target.elts):
                self._assign(part, self._item(value, k))
        else:
            raise KernelError(f"{value.type} cannot be assigned to {ast.unparse(target)}")

    def _place(self, node: ast.Subscript) -> tuple[Any, Type]:
        """Address of an entry, and its type."""
        base = self._value(node.value)
        if not isinstance(base.type, Pointer):
            raise KernelError(f"{base.type} has no entries")
        index = convert(self.builder, self._value(node.slice), INT)
        return self.builder.gep(base.code, [index.code]), base.type.element

    def _load(self, place: Any, kind: Type) -> Value:
        return Value(kind, self.builder.load(place))

    def _store(self, place: Any, kind: Type, value: Value) -> None:
        self.builder.store(convert(self.builder, value, kind).code, place)

    def _item(self, value: Value, k: int) -> Value:
        return Value(value.type.items[k], self.builder.extract_value(value.code, k))

    def _field(self, value: Value, name: str) -> Value:
        for k, (field, kind) in enumerate(value.type.fields):
            if field == name:
                place = self.builder.gep(value.code, [ir.Constant(WORD, k)])
                word = self.builder.load(place)
                word.set_metadata("invariant.load", self.module.constant_memory)
                if kind is INT:
                    return Value(INT, word)
                if kind is REAL:
                    return Value(REAL, self.builder.bitcast(word, llvm_type(REAL)))
                return Value(kind, self.builder.inttoptr(word, llvm_type(kind)))
        raise KernelError(f"{value.type} has no field {name}")

    # Expressions.

    def _static(self, node: ast.expr) -> Any:
        """What a name outside the function stands for; None for anything else."""
        if isinstance(node, ast.Name) and node.id not in self.local:
            if node.id in self.module.modules:
                return self.module.modules[node.id]
            known = self.python.__globals__
            return known[node.id] if node.id in known else getattr(builtins, node.id, None)
        if isinstance(node, ast.Attribute):
            owner = self._static(node.value)
            return getattr(owner, node.attr, None) if isinstance(owner, ModuleType) else None
        return None

    def _branch(self, test: ast.expr, yes: Any, no: Any) -> None:
        """Go on at ``yes`` if the test holds, else at ``no``."""
        if isinstance(test, ast.BoolOp):
            *first, last = test.values
            for value in first:
                following = self.function.append_basic_block()
                if isinstance(test.op, ast.And):
                    self._branch(value, following, no)
                else:
                    self._branch(value, yes, following)
                self.builder.position_at_end(following)
            self._branch(last, yes, no)
        elif isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
            self._branch(test.operand, no, yes)
        else:
            self.builder.cbranch(truth(self.builder, self._value(test)), yes, no)

    def _value(self, node: ast.expr, allow_none: bool = False) -> Value:
        method = getattr(self, f"_of_{type(node).__name__}", None)
        if method is None:
            raise KernelError(f"{type(node).__name__} is not translated")
        value = method(node)
        if value.type is NONE and not allow_none:
            raise KernelError(f"{ast.unparse(node)} has no value")
        return value

    def _of_Constant(self, node: ast.Constant) -> Value:
        return self._known(node.value, repr(node.value))

    def _known(self, value: Any, text: str) -> Value:
        if isinstance(value, bool | int | float | complex):
            return constant(value)
        raise KernelError(f"{text} is no number")

    def _of_Name(self, node: ast.Name) -> Value:
        if node.id in self.variables:
            kind, place = self.variables[node.id]
            return Value(kind, self.builder.load(place))
        if node.id in self.local:
            raise KernelError(f"{node.id} has no value yet")
        return self._known(self._static(node), node.id)

    def _of_Attribute(self, node: ast.Attribute) -> Value:
        known = self._static(node)
        if known is not None:
            return self._known(known, ast.unparse(node))
        owner = self._value(node.value)
        if isinstance(owner.type, Record):
            return self._field(owner, node.attr)
        if owner.type == COMPLEX and node.attr in ("real", "imag"):
            return Value(REAL, parts(self.builder, owner)[node.attr == "imag"])
        raise KernelError(f"{owner.type} has no {node.attr}")

    def _of_Subscript(self, node: ast.Subscript) -> Value:
        if isinstance(node.value, ast.Name) and node.value.id in self.variables:
            kind = self.variables[node.value.id][0]
            if isinstance(kind, Tuple):
                if not isinstance(node.slice, ast.Constant):
                    raise KernelError("the index of a tuple must be a constant")
                return self._item(self._value(node.value), node.slice.value)
        return self._load(*self._place(node))

    def _of_Tuple(self, node: ast.Tuple) -> Value:
        items = [self._value(item) for item in node.elts]
        kind = several(tuple(item.type for item in items))
        code = ir.Constant(llvm_type(kind), ir.Undefined)
        for k, item in enumerate(items):
            code = self.builder.insert_value(code, item.code, k)
        return Value(kind, code)

    def _of_BinOp(self, node: ast.BinOp) -> Value:
        left, right = self._value(node.left), self._value(node.right)
        return operators.binary(self.builder, node.op, left, right)

    def _of_UnaryOp(self, node: ast.UnaryOp) -> Value:
        if isinstance(node.op, ast.Not):
            return Value(BOOL, self.builder.not_(truth(self.builder, self._value(node.operand))))
        return operators.unary(self.builder, node.op, self._value(node.operand))

    def _of_BoolOp(self, node: ast.BoolOp) -> Value:
        return self._of_IfExp(ast.IfExp(node, ast.Constant(True), ast.Constant(False)))

    def _of_IfExp(self, node: ast.IfExp) -> Value:
        yes, no, after = (self.function.append_basic_block() for _ in range(3))
        self._branch(node.test, yes, no)
        ends = []
        values = []
        for block, expression in ((yes, node.body), (no, node.orelse)):
            self.builder.position_at_end(block)
            values.append(self._value(expression))
            ends.append(self.builder.block)
        kinds = {v.type for v in values}
        if len(kinds) > 1 and not kinds <= set(NUMBERS):
            raise KernelError(f"one of {', '.join(map(str, kinds))}: no type in common")
        kind = max((v.type for v in values), key=NUMBERS.index) if len(kinds) > 1 else kinds.pop()
        codes = []
        for end, value in zip(ends, values, strict=True):
            self.builder.position_at_end(end)
            codes.append(convert(self.builder, value, kind).code)
            self.builder.branch(after)
        self.builder.position_at_end(after)
        result = self.builder.phi(llvm_type(kind))
        for code, end in zip(codes, ends, strict=True):
            result.add_incoming(code, end)
        return Value(kind, result)

    def _of_Compare(self, node: ast.Compare) -> Value:
        left = self._value(node.left)
        result = None
        for operator, comparator in zip(node.ops, node.comparators, strict=True):
            if isinstance(operator, ast.In | ast.NotIn):
                bit = self._contains(left, comparator)
                bit = self.builder.not_(bit) if isinstance(operator, ast.NotIn) else bit
            else:
                right = self._value(comparator)
                bit = operators.compare(self.builder, operator, left, right)
                left = right
            result = bit if result is None else self.builder.and_(result, bit)
        return Value(BOOL, result)

    def _contains(self, value: Value, node: ast.expr) -> Any:
        if not isinstance(node, ast.Tuple):
            raise KernelError("in needs a tuple")
        found = ir.Constant(BIT, 0)
        for item in node.elts:
            same = operators.compare(self.builder, ast.Eq(), value, self._value(item))
            found = self.builder.or_(found, same)
        return found

    def _of_Call(self, node: ast.Call) -> Value:
        if node.keywords:
            raise KernelError("arguments must not be named")
        if isinstance(node.func, ast.Attribute) and node.func.attr == "conjugate":
            re, im = parts(
                self.builder, convert(self.builder, self._value(node.func.value), COMPLEX)
            )
            return OPERATIONS[complex](
                self.builder, [Value(REAL, re), Value(REAL, self.builder.fneg(im))]
            )
        function = self._static(node.func)
        arguments = [self._value(a) for a in node.args]
        operation: Callable[..., Value] | None = OPERATIONS.get(function)
        if operation is not None:
            return operation(self.builder, arguments)
        if not isinstance(function, FunctionType):
            raise KernelError(f"{ast.unparse(node.func)} cannot be called")
        callee, result = self.module.translated(function, tuple(a.type for a in arguments))
        codes = [a.code for a in arguments]
        if result is NONE:
            self.builder.call(callee, codes)
            return Value(NONE, None)
        place = self.reserve.alloca(llvm_type(result))
        self.builder.call(callee, [self.builder.bitcast(place, BYTE.as_pointer()), *codes])
        return self._load(place, result)
