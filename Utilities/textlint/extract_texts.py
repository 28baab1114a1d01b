# SPDX-License-Identifier: BSD-3-Clause
"""The texts that the program prints and that its references are made of, as pages for the linter of words:
extract_texts.py FOLDER FILE...

Each file gives FOLDER/FILE.md, in which each text stands on the line on which it stands in the file. Texts are the
values of Filters/Parameters.json, strings of C++ with several words, comments of headers for Doxygen,
docstrings and strings with several words of Python, and what proxies of ParaView document.
"""

import ast
import json
import re
import sys
from pathlib import Path

TEXT_KEYS = ("title", "text", "short", "details", "why", "thesis_text")
# A string, a comment of Doxygen, or what has to be stepped over.
CPP = re.compile(r"""
    (?P<doxygen>///<?(?P<line>[^\n]*)|/\*\*(?P<block>.*?)\*/)
  | (?P<comment>//[^\n]*|/\*.*?\*/)
  | (?P<include>\#\s*include[^\n]*)
  | (?P<raw>R"(?P<mark>[^(\s]*)\((?P<rawtext>.*?)\)(?P=mark)")
  | "(?P<string>(?:[^"\\\n]|\\.)*)"
  | '(?:[^'\\\n]|\\.)+'
""", re.X | re.S)
ESCAPES = {r"\n": " ", r"\"": '"', r"\\": "\\", r"\t": " "}
# A text goes on behind what is put into it.
JOINS = re.compile(r"^\s*(\+|<<)|(\+|<<)\s*$")
SEVERAL_WORDS = re.compile(r"[A-Za-z]{2,}[,;:]? +[a-z(]+")


class Page:
    """Lines of Markdown, of which each begins a text or goes on with the one above it."""

    def __init__(self, count):
        self.lines = [""] * count

    def put(self, line, text, goes_on=False):
        """Onto the line, counted from 0."""
        text = re.sub(r"\s+", " ", text).strip().replace("|", " ")
        if not text:
            return
        old = self.lines[line]
        if old:
            self.lines[line] = old + (" " if goes_on else ". ") + text
        else:
            self.lines[line] = ("  " if goes_on else "- ") + text


def of_list(source):
    """Of the list of parameters, whose lines have a few keys each."""
    page = Page(source.count("\n") + 1)
    for number, line in enumerate(source.split("\n")):
        for key, text in re.findall(r'"(\w+)": ("(?:[^"\\]|\\.)*")', line):
            if key in TEXT_KEYS:
                page.put(number, json.loads(text))
        if re.match(r'\s*"', line) and not re.match(r'\s*"\w+": ', line):
            page.put(number, json.loads(line.strip().rstrip(",")).lstrip("- "))
    return page


def put_comment(page, number, text):
    """A comment of Doxygen: a paragraph is a text, and so is each entry of a list."""
    goes_on = False
    for offset, line in enumerate(text.split("\n")):
        line = re.sub(r"^\s*\*( |$)", "", line).strip().removeprefix("///").strip()
        line = re.sub(r"^[@\\](par|brief|return|returns|param \w+|tparam \w+|class)\s*", "", line)
        if not line or re.match(r"[@\\]", line):
            goes_on = False
            continue
        if line.startswith("- "):
            line, goes_on = line[2:], False
        page.put(number + offset, line, goes_on)
        goes_on = True


def of_cpp(source, is_header):
    """Of C++: comments for Doxygen in a header, and strings of several words with what is put into them."""
    page = Page(source.count("\n") + 1)
    end, last_doxygen, last_string = 0, -2, False
    for found in CPP.finditer(source):
        number = source.count("\n", 0, found.start())
        if found["doxygen"]:
            if not is_header:
                continue
            if found["block"] is not None:
                put_comment(page, number, found["block"])
            elif last_doxygen == number - 1 and page.lines[number - 1] and found["line"].strip():
                item = found["line"].strip()
                page.put(number, item.removeprefix("- "), not item.startswith("- "))
            else:
                page.put(number, found["line"].strip().removeprefix("- "))
            last_doxygen = number if found["line"] is not None else -2
        elif found["string"] is not None:
            between = source[end:found.start()]
            text = re.sub(r"\\.", lambda match: ESCAPES.get(match[0], ""), found["string"])
            text = re.sub(r"%[-+.0-9]*[a-z]+", "N", text)
            goes_on = last_string and (not between.strip() or bool(JOINS.search(between)))
            goes_on = goes_on and not re.search(r"[;{}]", between)
            if goes_on and between.strip():
                text = ("" if re.fullmatch(r"\s*(\+|<<)\s*", between) else "N ") + text
            if goes_on or SEVERAL_WORDS.search(text):
                page.put(number, text, goes_on)
                last_string = True
            else:
                last_string = False
            end = found.end()
    return page


def of_python(source):
    """Of Python: docstrings by their paragraphs, and strings of several words."""
    page = Page(source.count("\n") + 1)
    tree = ast.parse(source)
    docstrings = set()
    for node in ast.walk(tree):
        body = getattr(node, "body", None)
        if isinstance(body, list) and body and isinstance(body[0], ast.Expr):
            docstrings.add(id(body[0].value))
    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr):
            parts = [part.value if isinstance(part, ast.Constant) else "N" for part in node.values]
            docstrings.update(id(part) for part in node.values)
            text = "".join(parts)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in docstrings:
            text = node.value
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) in docstrings:
            if SEVERAL_WORDS.search(node.value) and source.split("\n")[node.lineno - 1].lstrip(" rf").startswith('"""'):
                put_comment(page, node.lineno - 1, node.value)
            continue
        else:
            continue
        # Lines of a layout are no sentence.
        for line in text.split("\n"):
            if SEVERAL_WORDS.search(line):
                page.put(node.lineno - 1, re.sub(r"%[-+.0-9]*[a-z]\b", "N", line))
    return page


def of_xml(source):
    """Of proxies of ParaView: what they document."""
    page = Page(source.count("\n") + 1)
    for found in re.finditer(r'<Documentation[^>]*>([^<]*)|_help="([^"]*)"', source):
        group = 2 if found[1] is None else 1
        for offset, line in enumerate(found[group].split("\n")):
            page.put(source.count("\n", 0, found.start(group)) + offset, line, goes_on=offset > 1)
    return page


def main(folder, names):
    for name in names:
        source = Path(name).read_text(encoding="utf-8")
        if name.endswith(".json"):
            page = of_list(source)
        elif name.endswith(".py"):
            page = of_python(source)
        elif name.endswith((".xml", ".xml.in")):
            page = of_xml(source)
        else:
            page = of_cpp(source, is_header=name.endswith((".h", ".h.in")))
        path = folder / f"{name}.md"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("\n".join(page.lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2:])
