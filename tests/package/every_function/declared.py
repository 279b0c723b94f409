#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""declared.py INCLUDE > every_function.cpp

A program that takes the address of every function which the headers of INCLUDE/trueaxis declare
without a body, and calls every constructor: it links where the library has them all. It includes
the umbrella header alone. A declaration that this does not understand is an error.
"""
import glob
import os
import re
import sys


def declarations(text):
    """(scopes, text) of every statement with a parenthesis outside of bodies and initialisers."""
    text = re.sub(r"/\*.*?\*/", "", re.sub(r"//.*", "", text), flags=re.S)
    text = re.sub(r"^\s*#.*$", "", text, flags=re.M)
    scopes, found, start, at = [], [], 0, 0
    while at < len(text):
        if text[at] == "(":
            at = closed(text, at)
        elif text[at] == "{":
            head = re.match(r"\s*(?:public:|private:)?\s*(namespace|class|struct)\s+([\w:]+)[^=(]*$", text[start:at])
            if head:
                scopes.append(head.group(2))
                start = at + 1
            else:
                at = closed(text, at)
                if not re.match(r"\s*[;,]", text[at + 1:]):  # the body of a function
                    start = at + 1
        elif text[at] == "}":
            scopes.pop()
            start = at + 1
        elif text[at] == ";":
            one = " ".join(re.sub(r"\b(public|private|protected):", "", text[start:at]).split())
            if "(" in one.split(" = ")[0] and not re.search(r" = (default|delete|0)$", one):
                first, *more = re.split(r"(?<=\) const), ", one)  # two functions in one declaration
                found += [(list(scopes), one) for one in [first] + [first.split()[0] + " " + m for m in more]]
            start = at + 1
        at += 1
    return found


def closed(text, at):
    """Where the bracket at `at` closes."""
    depth = 0
    for i in range(at, len(text)):
        depth += (text[i] in "({[") - (text[i] in ")}]")
        if depth == 0:
            return i
    raise ValueError(text[at:at + 80])


def parameters(text):
    """The parameters without their defaults, each with a name."""
    parts, depth, last = [], 0, 0
    for i, c in enumerate(text + ","):
        depth += (c in "({[<") - (c in ")}]>")
        if c == "," and depth == 0:
            parts.append(text[last:i].split(" = ")[0].strip())
            last = i + 1
    return [p if re.search(r"[\w>&*] ?\w+$", p) and not p.endswith("&") else p + " one" for p in parts if p]


def program(include):
    lines = []
    for path in sorted(glob.glob(os.path.join(include, "trueaxis", "*.hpp"))):
        with open(path) as file:
            for scopes, one in declarations(file.read()):
                if one.startswith("template "):
                    continue  # the header has all of it
                one = re.sub(r"^(explicit|virtual|static|inline|constexpr) ", "", one)
                head = re.fullmatch(r"(.*?)(operator ?\(\)|operator ?[^\s(]+|~?\w+) ?\((.*)\)((?: const| noexcept)*)", one)
                if not head:
                    raise SystemExit(f"{path}: not understood: {one}")
                returned, name, given, behind = head.groups()
                given = parameters(given)
                outer = [s for s in scopes if s == s.lower()]
                number = len(lines)
                begin, end = f"namespace {'::'.join(outer)} {{ ", " }"
                if name.startswith("~"):
                    continue  # a constructed object is destroyed
                if scopes[-1] == name:
                    names = ", ".join(f"static_cast<decltype({n})&&>({n})" for n in (re.search(r"\w+$", p).group() for p in given))
                    lines.append(f"{begin}void made{number}({', '.join(given)}) {{ {name} it({names}); }}{end}")
                else:
                    member = scopes[len(outer):]
                    of = "::".join(member) + "::" if member else ""
                    lines.append(f"{begin}{returned}({of}*one{number})({', '.join(given)}){behind} = &{of}{name};{end}")
    if not lines:
        raise SystemExit(f"{include}: no public header declares a function")
    return "#include <trueaxis/trueaxis.hpp>\n" + "\n".join(lines) + f"\nint main() {{}}  // {len(lines)} functions\n"


if __name__ == "__main__":
    sys.stdout.write(program(sys.argv[1]))
