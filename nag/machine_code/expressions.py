"""Expressions of Python translated to LLVM's language, and the memory that they read and write."""

from __future__ import annotations

import ast
import builtins
import operator
from types import FunctionType, MethodType, ModuleType
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
    Constant,
    Pointer,
    Record,
    Tuple,
    Type,
    constant_type,
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

# Numbers that are compiled.
_NUMBER = bool | int | float | complex
# What is worked out of whole numbers that are known when the kernel is compiled.
_FIXED: dict[type, Any] = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Eq: operator.eq}
_FIXED |= {ast.NotEq: operator.ne, ast.Lt: operator.lt, ast.LtE: operator.le}
_FIXED |= {ast.Gt: operator.gt, ast.GtE: operator.ge}


class Expressions:
    """Variables and expressions of a function that is being translated.

    Variables live in memory that the first block reserves; LLVM makes registers of them. A
    variable keeps the type that it gets first. ``assigned`` are those that have a value wherever
    the way to here led along; ``fails`` says whether a division by zero may end the function;
    ``size`` counts the syntax nodes of functions that are put in.
    """

    def __init__(self, module: Any, python: FunctionType, function: ir.Function) -> None:
        self.module, self.python, self.function = module, python, function
        self.reserve = ir.IRBuilder(function.append_basic_block("variables"))
        self.builder = ir.IRBuilder(function.append_basic_block("start"))
        self.variables: dict[str, tuple[Type, Any]] = {}
        self.assigned: set[str] = set()
        self.local = set(python.__code__.co_varnames)
        self.fails = False
        self.size = 0

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
            fixed = isinstance(value.type, Constant)
            place = None if fixed else self.reserve.alloca(llvm_type(value.type), name=name)
            self.variables[name] = (value.type, place)
        kind, place = self.variables[name]
        try:
            code = convert(self.builder, value, kind).code
        except KernelError:
            raise KernelError(f"{name} is {kind} and cannot become {value.type}") from None
        if place is not None:
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
        return self._entry(self._value(node.value), node.slice)

    def _entry(self, base: Value, number: ast.expr) -> tuple[Any, Type]:
        if not isinstance(base.type, Pointer):
            raise KernelError(f"{base.type} has no entries")
        place = index(self.builder, self._value(number))
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
        """What is known when the kernel is compiled; None for anything else.

        That is what names outside the function stand for, arguments and variables that hold such
        objects, and attributes of these and of modules.
        """
        if isinstance(node, ast.Name) and node.id in self.variables:
            kind = self.variables[node.id][0]
            return kind.value if isinstance(kind, Constant) else None
        if isinstance(node, ast.Name) and node.id not in self.local:
            known = self.python.__globals__
            return known[node.id] if node.id in known else getattr(builtins, node.id, None)
        if isinstance(node, ast.Attribute):
            owner = self._static(node.value)
            if isinstance(owner, ModuleType) or self._is_fixed(node.value):
                return getattr(owner, node.attr, None)
        return None

    def _is_fixed(self, node: ast.expr) -> bool:
        """Whether it is an argument or variable that holds a constant, or an attribute of one."""
        if isinstance(node, ast.Attribute):
            return self._is_fixed(node.value)
        known = isinstance(node, ast.Name) and node.id in self.variables
        return known and isinstance(self.variables[node.id][0], Constant)

    def _fixed(self, node: ast.AST | None) -> Any:
        """The whole number, or bit, that is known when the kernel is compiled; else None.

        Numbers of items of tuples are, and with them what is made of them.
        """
        if isinstance(node, ast.Constant | ast.Name | ast.Attribute):
            value = node.value if isinstance(node, ast.Constant) else self._static(node)
            return value if isinstance(value, int) else None
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            value = self._fixed(node.operand)
            return None if value is None else -value
        if isinstance(node, ast.Call) and self._static(node.func) is len and len(node.args) == 1:
            kind = self._value(node.args[0]).type
            return len(kind.items) if isinstance(kind, Tuple) else None
        if isinstance(node, ast.BinOp) and type(node.op) in _FIXED:
            left, right = node.left, node.right
        elif isinstance(node, ast.Compare) and len(node.ops) == 1 and type(node.ops[0]) in _FIXED:
            left, right = node.left, node.comparators[0]
        else:
            return None
        values = self._fixed(left), self._fixed(right)
        sign = node.op if isinstance(node, ast.BinOp) else node.ops[0]
        value = None if None in values else _FIXED[type(sign)](*values)
        # What wraps round is left to the kernel.
        return value if value is None or -(2**63) <= value < 2**63 else None

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
        if isinstance(value, _NUMBER):
            return constant(value)
        raise KernelError(f"{text} is no number")

    def _of_Name(self, node: ast.Name) -> Value:
        if node.id in self.assigned:
            kind, place = self.variables[node.id]
            return Value(kind, None if place is None else self.builder.load(place))
        if node.id in self.local:
            raise KernelError(f"{node.id} may have no value yet")
        return self._known(self._static(node), node.id)

    def _of_Attribute(self, node: ast.Attribute) -> Value:
        known = self._static(node)
        if known is not None:
            if self._is_fixed(node) and not isinstance(known, _NUMBER):
                return Value(constant_type(known), None)
            return self._known(known, ast.unparse(node))
        owner = self._value(node.value)
        if isinstance(owner.type, Record):
            return self._field(owner, node.attr)
        if owner.type == COMPLEX and node.attr in ("real", "imag"):
            return Value(REAL, parts(self.builder, owner)[node.attr == "imag"])
        raise KernelError(f"{owner.type} has no {node.attr}")

    def _of_Subscript(self, node: ast.Subscript) -> Value:
        base = self._value(node.value)
        if isinstance(base.type, Tuple):
            return self._part(base, node.slice)
        return self._load(*self._entry(base, node.slice))

    def _part(self, value: Value, node: ast.expr) -> Value:
        """An item of a tuple, or several that follow each other."""
        bounds = [node.lower, node.upper, node.step] if isinstance(node, ast.Slice) else [node]
        known = [self._fixed(part) for part in bounds]
        for part, k in zip(bounds, known, strict=True):
            if part is not None and k is None and not isinstance(part, ast.Constant):
                raise KernelError("the index of a tuple must be a constant")
        if len(bounds) == 1:
            count, k = len(value.type.items), known[0]
            k = node.value if isinstance(node, ast.Constant) else k
            return self._item(value, k + count if type(k) is int and -count <= k < 0 else k)
        for part, k in zip(bounds, known, strict=True):
            if part is not None and type(k) is not int:
                raise KernelError("a tuple is cut at whole numbers")
        return self._tuple(self._items(value)[slice(*known)])

    def _items(self, value: Value) -> list[Value]:
        return [self._item(value, k) for k in range(len(value.type.items))]

    def _tuple(self, items: list[Value]) -> Value:
        kind = several(tuple(item.type for item in items))
        code = ir.Constant(llvm_type(kind), ir.Undefined)
        for k, item in enumerate(items):
            code = self.builder.insert_value(code, item.code, k)
        return Value(kind, code)

    def _of_Tuple(self, node: ast.Tuple) -> Value:
        items: list[Value] = []
        for item in node.elts:
            if isinstance(item, ast.Starred):
                inner = self._value(item.value)
                if not isinstance(inner.type, Tuple):
                    raise KernelError(f"{inner.type} is no tuple")
                items += self._items(inner)
            else:
                items.append(self._value(item))
        return self._tuple(items)

    def _of_BinOp(self, node: ast.BinOp) -> Value:
        known = self._fixed(node)
        if known is not None:
            return constant(known)
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
                # The line may have moved since the kernel was compiled.
                place = f"{self.python.__code__.co_filename}, {self.python.__name__}"
                text = f"{place}: division of a whole number by zero in {ast.unparse(node)}"
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
        known = self._fixed(node.test)
        if known is not None:
            return self._value(node.body if known else node.orelse)
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
        known = self._fixed(node)
        if known is not None:
            return constant(known)
        left = self._value(node.left)
        if len(node.ops) > 1:
            return self._chain(node, left)
        sign, comparator = node.ops[0], node.comparators[0]
        if isinstance(sign, ast.In | ast.NotIn):
            bit = self._contains(left, comparator)
            return Value(BOOL, self.builder.not_(bit) if isinstance(sign, ast.NotIn) else bit)
        return Value(BOOL, operators.compare(self.builder, sign, left, self._value(comparator)))

    def _chain(self, node: ast.Compare, left: Value) -> Value:
        """Comparisons one after the other, until one does not hold."""
        after = self.function.append_basic_block()
        ends = []
        for k, (sign, comparator) in enumerate(zip(node.ops, node.comparators, strict=True)):
            if isinstance(sign, ast.In | ast.NotIn):
                raise KernelError("in is not chained")
            right = self._value(comparator)
            bit = operators.compare(self.builder, sign, left, right)
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
        known = self._fixed(node)
        if known is not None:
            return constant(known)
        function = self._static(node.func)
        arguments = [self._value(a) for a in node.args]
        if isinstance(function, MethodType):
            owner = function.__self__
            arguments.insert(0, Value(constant_type(owner), None))
            function = function.__func__
        emitted = operation(function)
        if emitted is not None:
            count, emit = emitted
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
        codes = [a.code for a in arguments if not isinstance(a.type, Constant)]
        place = None
        if callee.result is not NONE:
            place = self.reserve.alloca(llvm_type(callee.result))
            codes.insert(0, self.builder.bitcast(place, BYTE.as_pointer()))
        # What a function does with the rest of a tuple is one with what it does.
        is_put_in = callee.is_put_in or function is self.python
        self.size += callee.size if is_put_in else 0
        attributes = ("alwaysinline",) if is_put_in else ()
        self.builder.call(callee.function, [*codes, self.function.args[-1]], attrs=attributes)
        if callee.fails:
            check_call(self.function, self.builder)
            self.fails = True
        return Value(NONE, None) if place is None else self._load(place, callee.result)
