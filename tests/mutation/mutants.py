"""Where the code of a room can be changed, and a copy of a file in which every change waits for its number.

A mutant is a stretch of a file and what stands there instead, in which `mutation::on(N)` chooses (mutant.h), so that
a file compiles once for all of its mutants. Positions are bytes, as libclang counts them.
"""

import dataclasses
import hashlib
import re

from clang.cindex import CursorKind, Index, TranslationUnit, TypeKind

SWAPS = {"<": ("<=", ">="), "<=": ("<", ">"), ">": (">=", "<="), ">=": (">", "<"), "==": ("!=",), "!=": ("==",),
         "&&": ("||",), "||": ("&&",), "+": ("-",), "-": ("+",), "*": ("/",), "/": ("*",), "%": ("*",),
         "&": ("|",), "|": ("&",), "<<": (">>",), ">>": ("<<",),
         "+=": ("-=",), "-=": ("+=",), "*=": ("/=",), "/=": ("*=",), "|=": ("&=",), "&=": ("|=",)}

FLOATS = (TypeKind.DOUBLE, TypeKind.FLOAT)
NUMBERS = (*FLOATS, TypeKind.BOOL, TypeKind.CHAR_S, TypeKind.SCHAR, TypeKind.UCHAR, TypeKind.SHORT, TypeKind.USHORT,
           TypeKind.INT, TypeKind.UINT, TypeKind.LONG, TypeKind.ULONG, TypeKind.LONGLONG, TypeKind.ULONGLONG)

CONSTANT_ANYHOW = (CursorKind.STATIC_ASSERT, CursorKind.ENUM_DECL, CursorKind.TYPE_ALIAS_DECL, CursorKind.TYPE_REF)
FUNCTIONS = (CursorKind.FUNCTION_DECL, CursorKind.CXX_METHOD, CursorKind.FUNCTION_TEMPLATE, CursorKind.DESTRUCTOR,
             CursorKind.CONVERSION_FUNCTION)
VARIABLES = (CursorKind.VAR_DECL, CursorKind.FIELD_DECL, CursorKind.PARM_DECL)
STATEMENTS = (CursorKind.CALL_EXPR, CursorKind.BINARY_OPERATOR, CursorKind.COMPOUND_ASSIGNMENT_OPERATOR,
              CursorKind.UNARY_OPERATOR, CursorKind.BREAK_STMT, CursorKind.CONTINUE_STMT)
BODIES_LAST = (CursorKind.FOR_STMT, CursorKind.WHILE_STMT, CursorKind.CXX_FOR_RANGE_STMT)


@dataclasses.dataclass(frozen=True)
class Mutant:
    file: str  # relative to the root
    line: int
    function: str
    begin: int
    end: int
    place: str  # the line's text, and which one of equal lines
    change: str  # "a < b  becomes  a <= b"
    text: str  # of the file from begin to end, with @ for mutation::on(N) and $ for its sign

    def key(self):
        return f"{self.file}\t{self.place}\t{self.change}"

    def rank(self, seed):
        """Its place in a sample, whatever else is there."""
        return hashlib.sha256(f"{seed}\t{self.key()}\t{self.begin - self.line}".encode()).hexdigest()


class Finder:
    """All mutants of one file."""

    def __init__(self, root, path, arguments):
        self.root, self.path = root, path
        self.source = path.read_bytes()
        self.found = []
        self.headers = {}
        self.function = ""
        unit = Index.create().parse(str(path), args=arguments,
                                    options=TranslationUnit.PARSE_DETAILED_PROCESSING_RECORD)
        here = [cursor for cursor in unit.cursor.get_children()
                if cursor.location.file and cursor.location.file.name == str(path)]
        self.macros = [span(cursor) for cursor in here if cursor.kind == CursorKind.MACRO_INSTANTIATION]
        for cursor in here:
            self.visit(cursor, ())

    def text(self, begin, end):
        return self.source[begin:end].decode()

    def of(self, cursor):
        return self.text(*span(cursor))

    def add(self, begin, end, was, becomes, text):
        if any(begin < stop and start < end for start, stop in self.macros):
            return
        line = self.source.count(b"\n", 0, begin)
        lines = self.source.decode().split("\n")
        which = sum(other.strip() == lines[line].strip() for other in lines[:line])
        place = lines[line].strip() + (f" [{which + 1}]" if which else "")
        change = f"{' '.join(was.split())}  becomes  {' '.join(becomes.split())}"
        before = sum(one.line == line + 1 and one.change.split("  at ")[0] == change for one in self.found)
        change += f"  at {before + 1}" if before else ""
        self.found.append(Mutant(str(self.path.relative_to(self.root)), line + 1, self.function, begin, end, place, change, text))

    def visit(self, cursor, above):
        kind = cursor.kind
        if kind in CONSTANT_ANYHOW or self.is_constexpr(cursor):
            return
        if kind in (*FUNCTIONS, CursorKind.CONSTRUCTOR):
            self.function = cursor.spelling
        self.operators(cursor)
        self.conditions(cursor)
        self.constants(cursor, above)
        self.statements(cursor, above)
        for child in self.changeable_children(cursor):
            self.visit(child, (*above, cursor))

    def is_constexpr(self, cursor):
        if cursor.kind in (*FUNCTIONS, *VARIABLES, CursorKind.CONSTRUCTOR, CursorKind.IF_STMT):
            return re.match(r"[^{(=]*\bconst(expr|eval|init)\b", self.of(cursor)) is not None
        return cursor.kind == CursorKind.DECL_STMT and "constexpr" in self.of(cursor).split("=")[0]

    def changeable_children(self, cursor):
        children = list(cursor.get_children())
        if cursor.kind in FUNCTIONS:
            return [child for child in children if child.kind == CursorKind.COMPOUND_STMT]
        if cursor.kind == CursorKind.CONSTRUCTOR:
            return [child for child in children if child.kind != CursorKind.PARM_DECL]
        if cursor.kind == CursorKind.CASE_STMT:
            return children[1:]
        if cursor.kind in VARIABLES:  # not the type
            value = cursor.location.offset + len(cursor.spelling.encode())
            bounds = re.match(r"(\[[^]]*\])+", self.text(value, span(cursor)[1]))
            value += bounds.end() if bounds else 0
            return [child for child in children if span(child)[0] >= value]
        return children

    # what changes

    def operators(self, cursor):
        begin, end = span(cursor)
        if cursor.kind in (CursorKind.BINARY_OPERATOR, CursorKind.COMPOUND_ASSIGNMENT_OPERATOR):
            left, right = operands = list(cursor.get_children())
            middle = self.text(span(left)[1], span(right)[0])
            operator = middle.strip()
            whole = {"%", "&", "|", "<<", ">>"} & {operator}
            if operator not in SWAPS or not all(is_number(one) for one in operands) or whole and is_float(cursor):
                return
            for other in SWAPS[operator]:
                changed = self.of(left) + middle.replace(operator, other) + self.of(right)
                self.add(begin, end, self.of(cursor), changed, f"(@ ? ({changed}) : ({self.of(cursor)}))")
        elif cursor.kind == CursorKind.UNARY_OPERATOR:
            operand = next(cursor.get_children())
            operator = self.text(begin, span(operand)[0]).strip()
            if operator in ("!", "-"):
                self.add(begin, end, self.of(cursor), self.of(operand), f"(@ ? ({self.of(operand)}) : ({self.of(cursor)}))"
                         if is_number(operand) else f"(@ != ({self.of(cursor)}))" if operator == "!" else
                         f"($ * ({self.of(cursor)}))")
        elif cursor.kind == CursorKind.CALL_EXPR and cursor.spelling in ("operator+", "operator-"):
            self.vector_sum(cursor)

    def vector_sum(self, cursor):
        """Eigen's sums are of other types than its differences: the sign of the second term changes."""
        operands = list(cursor.get_arguments())
        type_name = cursor.type.get_canonical().spelling
        if len(operands) != 2 or "Eigen::" not in type_name or "double" not in type_name:
            return
        left, right = map(self.of, operands)
        operator = cursor.spelling[-1]
        self.add(*span(cursor), self.of(cursor), f"{left} {SWAPS[operator][0]} {right}",
                 f"({left} {operator} $ * ({right}))")

    def conditions(self, cursor):
        if cursor.kind not in (CursorKind.IF_STMT, CursorKind.CONDITIONAL_OPERATOR):
            return
        condition = next(cursor.get_children())
        if condition.kind in (*VARIABLES, CursorKind.DECL_STMT) or ";" in self.of(condition):
            return
        text = self.of(condition)
        self.add(*span(condition), text, "true", f"(@ || ({text}))")
        self.add(*span(condition), text, "false", f"(!@ && ({text}))")

    def constants(self, cursor, above):
        text, kind = self.of(cursor), cursor.kind
        if kind == CursorKind.INTEGER_LITERAL:
            changed = "1" if text == "0" else f"{text} + 1"
        elif kind == CursorKind.FLOATING_LITERAL:
            changed = "1.0" if float_of(text) == 0 else f"{'1000' if 'e-' in text or 'p-' in text else '2'} * {text}"
        elif kind == CursorKind.CXX_BOOL_LITERAL_EXPR:
            changed = "false" if text == "true" else "true"
        elif kind == CursorKind.DECL_REF_EXPR:
            declared = self.declaration(cursor)
            if not declared:
                return
            tiny = re.search(r"e-\d|p-\d", declared)
            changed = f"{'1000' if tiny else '2'} * {text}" if is_float(cursor) else f"{text} + 1"
        else:
            return
        self.add(*span(cursor), text, changed, f"static_cast<{type_wanted(cursor, above)}>(@ ? {changed} : {text})")

    def declaration(self, cursor):
        """Of a constant with a name."""
        named = cursor.referenced
        if named is None or named.kind != CursorKind.VAR_DECL or not is_number(named) or not named.location.file:
            return ""
        name = named.location.file.name
        if name not in self.headers:
            with open(name, "rb") as file:
                self.headers[name] = file.read()
        begin, end = span(named)
        text = self.headers[name][begin:end].decode()
        return text if "constexpr" in text else ""

    def statements(self, cursor, above):
        if not above or cursor.kind not in STATEMENTS or not is_statement(cursor, above[-1]):
            return
        begin, end = span(cursor)
        if self.source[end:].lstrip()[:1] == b";":
            self.add(begin, end, self.of(cursor), "nothing", f"if (@) {{}} else {self.of(cursor)}")


def span(cursor):
    return cursor.extent.start.offset, cursor.extent.end.offset


def is_number(cursor):
    return cursor.type.get_canonical().kind in NUMBERS


def is_float(cursor):
    return cursor.type.get_canonical().kind in FLOATS


def float_of(text):
    digits = text.rstrip("fFlL")
    return float.fromhex(digits) if digits.lower().startswith("0x") else float(digits.replace("'", ""))


def is_statement(cursor, parent):
    if parent.kind == CursorKind.COMPOUND_STMT:
        return True
    children = list(parent.get_children())
    if parent.kind == CursorKind.IF_STMT:
        return cursor in children[1:]
    return parent.kind in BODIES_LAST and cursor == children[-1]


def type_wanted(cursor, above):
    """What the compiler makes of a constant: braces take no int for a double that is not constant."""
    wanted = cursor
    for parent in reversed(above):
        if parent.kind != CursorKind.UNEXPOSED_EXPR or span(parent) != span(cursor) or not is_number(parent):
            break
        wanted = parent
    return wanted.type.get_canonical().spelling.removeprefix("const ")


def mutants_of(root, path, arguments):
    return Finder(root, path, arguments).found


def sample(mutants, count, seed):
    """At most so many, in an order that the seed gives; of two that overlap the first."""
    chosen = []
    for mutant in sorted(mutants, key=lambda one: one.rank(seed)):
        if not any(one.file == mutant.file and one.begin < mutant.end and mutant.begin < one.end for one in chosen):
            chosen.append(mutant)
        if len(chosen) == count:
            break
    return chosen


def rewritten(source, numbered):
    """The file with its mutants in it, on the lines where they were."""
    for number, mutant in sorted(numbered, key=lambda one: -one[1].begin):
        text = mutant.text.replace("@", f"mutation::on({number})").replace("$", f"mutation::sign({number})")
        missing = source.count(b"\n", mutant.begin, mutant.end)
        text = text.replace("\n", " ") + "\n" * missing
        source = source[:mutant.begin] + text.encode() + source[mutant.end:]
    return b'#include "mutant.h"\n#line 1\n' + source
