#!/usr/bin/env python3
"""Fail where a function is longer, has more parameters or is nested deeper than .clang-tidy allows.

Takes a second over all sources, where clang-tidy takes half a minute per file. Reads what clang-format wrote: braces that
balance once comments and literals are taken out. Lambdas count as part of the function around them.
"""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
limit = dict(re.findall(r"readability-function-size\.(\w+)Threshold, value: '(\d+)'", (root / ".clang-tidy").read_text()))

# raw strings, comments, strings and characters; digits may be separated by '
literal = re.compile(r'R"(\w*)\((?:.|\n)*?\)\1"|//[^\n]*|/\*(?:.|\n)*?\*/|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])\'')
scope = re.compile(r"^(?!.*\)\s*(?:const|noexcept|override|final|\s)*$)(?:.*[\s>])?(?:namespace|class|struct|union|enum|extern)\b")


def blanked(text):
    """The same lines without comments and literals."""
    text = literal.sub(lambda m: "\n" * m[0].count("\n"), text)
    text = re.sub(r"\b(?:public|private|protected):", "", text)
    return re.sub(r"^[ \t]*#(?:.*\\\n)*.*", lambda m: "\n" * m[0].count("\n"), text, flags=re.MULTILINE)


def parameters(head):
    """Top-level commas of the first parentheses that follow a name, plus one."""
    start = re.search(r"(?:\w|operator\W+)\s*\(", re.sub(r"\b(?:decltype|noexcept|alignas)\s*\(", "[", head))
    if not start:
        return 0
    depth, count, some = 0, 1, False
    for c in head[start.end():]:
        if c == ")" and depth == 0:
            break
        depth += c in "(<[{"
        depth -= c in ")>]}"
        count += c == "," and depth == 0
        some = some or not c.isspace()
    return count if some else 0


def functions(text):
    """(line, head, lines of the body, deepest nesting) of every function's definition."""
    line, head, start, stack, deepest = 1, "", 1, [], 0
    for c in text:
        inside = "function" in stack
        if c == "{":
            if inside:
                stack.append("block" if not head.strip().endswith(("=", ",", "(", "return")) and re.search(r"(\)|else|do|try|->.*|mutable|;|^)\s*$", head.strip()) else "list")
                deepest = max(deepest, stack.count("block"))
            elif stack and stack[-1] == "list":
                stack.append("list")
            elif scope.search(" ".join(head.split())):
                stack.append("scope")
            elif "(" in head and re.search(r"\)[^()]*$|\}\s*$", head):
                stack.append("function")
                begun, header, deepest = (line, start), head, 0
            else:
                stack.append("list")
            head = "" if stack[-1] != "list" or inside else head + "{"
        elif c == "}":
            closed = stack.pop() if stack else ""
            if closed == "function":
                yield begun[1], header, line - begun[0], deepest
            head = head + "}" if closed == "list" and not inside else ""
        elif c == ";" and not (stack and stack[-1] == "list"):
            head = "" if head.count("(") <= head.count(")") else head + c
        else:
            if not head.strip():
                head, start = "", line
            head += c
        line += c == "\n"


errors = []
for path in sorted(p for room in ("src", "app", "tests") for p in (root / room).rglob("*.[ch]pp")):
    text = path.read_text()
    excused = {i + 2 for i, line in enumerate(text.splitlines()) if "NOLINTNEXTLINE(readability-function-size)" in line}
    for line, head, lines, nesting in functions(blanked(text)):
        if excused & {line, line + head.rstrip().count("\n")}:
            continue
        name = " ".join(head.split())[:60]
        for what, value in (("Line", lines), ("Parameter", parameters(head)), ("Nesting", nesting)):
            if value > int(limit[what]):
                errors.append(f"{path}:{line}: {what.lower()}s {value}, at most {limit[what]}: {name}")
print("\n".join(errors), file=sys.stderr)
sys.exit(bool(errors))
