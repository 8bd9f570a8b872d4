"""Expressions of Python translated to LLVM's language, and the memory that they read and write."""

from __future__ import annotations

import ast
import builtins
from types import FunctionType, ModuleType
from typing import Any

from llvmlite import ir

from nag.machine_code import operators
from nag.machine_code.failures import check_call, check_divisor
from nag.machine_code.operations import index, operation
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
    LocatedError,
    Value,
    complex_of,
    constant,
    convert,
    llvm_type,
    parts,
    truth,
)


class Expressions:
    """Variables and expressions of a function that is being translated.

    Variables live in memory that the first block reserves; LLVM makes registers of them. A
    variable keeps the type that it gets first. ``assigned`` are those that have a value wherever
    the way to here led along; ``fails`` says whether a division by zero may end the function.
    """

    def __init__(self, module: Any, python: FunctionType, function: ir.Function) -> None:
        self.module, self.python, self.function = module, python, function
        self.reserve = ir.IRBuilder(function.append_basic_block("variables"))
        self.builder = ir.IRBuilder(function.append_basic_block("start"))
        self.variables: dict[str, tuple[Type, Any]] = {}
        self.assigned: set[str] = set()
        self.local = set(python.__code__.co_varnames)
        self.fails = False

    def _place_of(self, node: ast.AST) -> str:
        code = self.python.__code__
        return f"{code.co_filename}:{code.co_firstlineno + getattr(node, 'lineno', 1) - 1}"

    def _fail(self, node: ast.AST, message: str) -> LocatedError:
        return LocatedError(f"{self._place_of(node)}: {message}")

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
        self.assigned.add(name)

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
        place = index(self.builder, self._value(node.slice))
        return self.builder.gep(base.code, [place]), base.type.element

    def _load(self, place: Any, kind: Type) -> Value:
        return Value(kind, self.builder.load(place))

    def _store(self, place: Any, kind: Type, value: Value) -> None:
        self.builder.store(convert(self.builder, value, kind).code, place)

    def _item(self, value: Value, k: Any) -> Value:
        if type(k) is not int or not 0 <= k < len(value.type.items):
            raise KernelError(f"{value.type} has no item {k!r}")
        return Value(value.type.items[k], self.builder.extract_value(value.code, k))

    def _field(self, value: Value, name: str) -> Value:
        for k, (field, kind) in enumerate(value.type.fields):
            if field == name:
                place = self.builder.gep(value.code, [ir.Constant(WORD, k)])
                word = self.builder.load(place)
                word.set_metadata("invariant.load", self.module.constant_memory)
                if kind is BOOL:
                    return Value(BOOL, truth(self.builder, Value(INT, word)))
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
            known = self.python.__globals__
            found = known[node.id] if node.id in known else getattr(builtins, node.id, None)
            if isinstance(found, ModuleType):
                return self.module.modules.get(node.id, found)
            return found
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
            raise self._fail(node, f"{type(node).__name__} is not translated")
        try:
            value = method(node)
        except LocatedError:
            raise
        except KernelError as error:
            raise self._fail(node, str(error)) from None
        if value.type is NONE and not allow_none:
            raise self._fail(node, f"{ast.unparse(node)} has no value")
        return value

    def _of_Constant(self, node: ast.Constant) -> Value:
        return self._known(node.value, repr(node.value))

    def _known(self, value: Any, text: str) -> Value:
        if isinstance(value, bool | int | float | complex):
            return constant(value)
        raise KernelError(f"{text} is no number")

    def _of_Name(self, node: ast.Name) -> Value:
        if node.id in self.assigned:
            kind, place = self.variables[node.id]
            return Value(kind, self.builder.load(place))
        if node.id in self.local:
            raise KernelError(f"{node.id} may have no value yet")
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
                return self._part(self._value(node.value), node.slice)
        return self._load(*self._place(node))

    def _part(self, value: Value, node: ast.expr) -> Value:
        """An item of a tuple, or several that follow each other."""
        bounds = [node.lower, node.upper, node.step] if isinstance(node, ast.Slice) else [node]
        if not all(part is None or isinstance(part, ast.Constant) for part in bounds):
            raise KernelError("the index of a tuple must be a constant")
        first, *others = [part and part.value for part in bounds]
        if not others:
            return self._item(value, first)
        if not all(k is None or type(k) is int for k in (first, *others)):
            raise KernelError("a tuple is cut at whole numbers")
        return self._tuple(self._items(value)[slice(first, *others)])

    def _items(self, value: Value) -> list[Value]:
        return [self._item(value, k) for k in range(len(value.type.items))]

    def _tuple(self, items: list[Value]) -> Value:
        kind = several(tuple(item.type for item in items))
        code = ir.Constant(llvm_type(kind), ir.Undefined)
        for k, item in enumerate(items):
            code = self.builder.insert_value(code, item.code, k)
        return Value(kind, code)

    def _of_Tuple(self, node: ast.Tuple) -> Value:
        return self._tuple([self._value(item) for item in node.elts])

    def _of_BinOp(self, node: ast.BinOp) -> Value:
        left, right = self._value(node.left), self._value(node.right)
        if isinstance(node.op, ast.Add) and isinstance(left.type, Tuple):
            if not isinstance(right.type, Tuple):
                raise KernelError(f"no Add of {left.type} and {right.type}")
            return self._tuple([*self._items(left), *self._items(right)])
        return self._operated(node, left, right)

    def _operated(self, node: ast.BinOp | ast.AugAssign, left: Value, right: Value) -> Value:
        if operators.divides_whole_numbers(node.op, left, right):
            known = isinstance(right.code, ir.Constant) and right.code.constant
            if not known:
                text = f"{self._place_of(node)}: division of a whole number by zero"
                check_divisor(self.function, self.builder, right, text)
                self.fails = True
        return operators.binary(self.builder, node.op, left, right)

    def _of_UnaryOp(self, node: ast.UnaryOp) -> Value:
        if isinstance(node.op, ast.Not):
            return Value(BOOL, self.builder.not_(truth(self.builder, self._value(node.operand))))
        return operators.unary(self.builder, node.op, self._value(node.operand))

    def _of_BoolOp(self, node: ast.BoolOp) -> Value:
        """One bit after the other, until one decides; of numbers Python makes no bit."""
        after = self.function.append_basic_block()
        ends = []
        for value in node.values:
            bit = self._value(value)
            if bit.type != BOOL:
                raise KernelError(f"{ast.unparse(value)} is {bit.type}, not bool")
            ends.append((bit.code, self.builder.block))
            if value is node.values[-1]:
                self.builder.branch(after)
            else:
                following = self.function.append_basic_block()
                ways = (following, after) if isinstance(node.op, ast.And) else (after, following)
                self.builder.cbranch(bit.code, *ways)
                self.builder.position_at_end(following)
        self.builder.position_at_end(after)
        return self._merged(BOOL, ends)

    def _merged(self, kind: Type, ends: list[tuple[Any, Any]]) -> Value:
        result = self.builder.phi(llvm_type(kind))
        for code, end in ends:
            result.add_incoming(code, end)
        return Value(kind, result)

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
        return self._merged(kind, list(zip(codes, ends, strict=True)))

    def _of_Compare(self, node: ast.Compare) -> Value:
        left = self._value(node.left)
        if len(node.ops) > 1:
            return self._chain(node, left)
        operator, comparator = node.ops[0], node.comparators[0]
        if isinstance(operator, ast.In | ast.NotIn):
            bit = self._contains(left, comparator)
            return Value(BOOL, self.builder.not_(bit) if isinstance(operator, ast.NotIn) else bit)
        return Value(BOOL, operators.compare(self.builder, operator, left, self._value(comparator)))

    def _chain(self, node: ast.Compare, left: Value) -> Value:
        """Comparisons one after the other, until one does not hold."""
        after = self.function.append_basic_block()
        ends = []
        for k, (operator, comparator) in enumerate(zip(node.ops, node.comparators, strict=True)):
            if isinstance(operator, ast.In | ast.NotIn):
                raise KernelError("in is not chained")
            right = self._value(comparator)
            bit = operators.compare(self.builder, operator, left, right)
            ends.append((bit, self.builder.block))
            left = right
            if k == len(node.ops) - 1:
                self.builder.branch(after)
            else:
                following = self.function.append_basic_block()
                self.builder.cbranch(bit, following, after)
                self.builder.position_at_end(following)
        self.builder.position_at_end(after)
        return self._merged(BOOL, ends)

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
            return self._conjugate(node.func, node.args)
        function = self._static(node.func)
        arguments = [self._value(a) for a in node.args]
        known = operation(function)
        if known is not None:
            count, emit = known
            if len(arguments) != count and (count is not None or len(arguments) < 2):
                wanted = "two or more" if count is None else count
                name = ast.unparse(node.func)
                raise KernelError(f"{name} takes {wanted} arguments here, not {len(arguments)}")
            return emit(self.builder, arguments)
        if not isinstance(function, FunctionType):
            raise KernelError(f"{ast.unparse(node.func)} cannot be called")
        return self._called(function, arguments)

    def _conjugate(self, node: ast.Attribute, arguments: list[ast.expr]) -> Value:
        value = self._value(node.value)
        if value.type != COMPLEX or arguments:
            raise KernelError(f"no conjugate({len(arguments)} arguments) of {value.type}")
        re, im = parts(self.builder, value)
        return complex_of(self.builder, re, self.builder.fneg(im))

    def _called(self, function: FunctionType, arguments: list[Value]) -> Value:
        callee = self.module.translated(function, tuple(a.type for a in arguments))
        codes = [a.code for a in arguments]
        place = None
        if callee.result is not NONE:
            place = self.reserve.alloca(llvm_type(callee.result))
            codes.insert(0, self.builder.bitcast(place, BYTE.as_pointer()))
        self.builder.call(callee.function, [*codes, self.function.args[-1]])
        if callee.fails:
            check_call(self.function, self.builder)
            self.fails = True
        return Value(NONE, None) if place is None else self._load(place, callee.result)
