#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whether every block of code in the documentation is run, or says why not: check_blocks.py ROOT

Code stands in fenced blocks of a known language, never merely indented. Of blocks that are not run the
syntax is right, and the files of the repository that they name exist; for each reason there are no more
of them than MOST. What is saved is used. JSON can be read. Prints what is not run, and what does not hold.
"""

import ast
import collections
import json
import re
import subprocess
import sys

from markdown_pages import ELSEWHERE, LANGUAGES, PACKAGES, REASONS, Block, pages
from repository_copy import repository_copy

# The test that compiles what the page saves.
COMPILED_BY = {"Documentation/Developers/Extending.md": "Documentation.recipe"}
# So many blocks may go without being run; who adds one says so here.
MOST = {"root": 3, "build": 8, "long": 6, "window": 1, "cluster": 3}


def indented_code(page):
    before, is_list = "", False
    for part in page.parts:
        line = "" if isinstance(part, Block) else part[1]
        is_list = bool(re.match(r" *([-*]|\d+\.) ", line)) or (is_list and (not line or line.startswith(" ")))
        if line.startswith("    ") and not before and not is_list:
            yield f"{page.name}:{part[0]}: indented code: use a fence"
        before = line.strip()


def bad_syntax(block):
    """What is wrong with the text of a block that nobody runs; None if nothing is."""
    if block.language == "sh":
        process = subprocess.run(["bash", "-n"], input=block.text, capture_output=True, text=True)
        return process.stderr or None
    try:
        if block.language == "python":
            ast.parse(block.text)
        elif block.language == "json":
            json.loads(block.text)
    except (ValueError, SyntaxError) as error:
        return error
    return None


def missing_files(block, page, root):
    saved = {other.value("file") for other in page.blocks}
    for name in re.findall(r"\b(?:bash|python3) ((?:\w+/)*\w[\w.]*\.(?:sh|py))\b", block.text):
        if not (root / name).exists() and name not in saved:
            yield name


def is_used(saved, page):
    """Whether a block names the file, or the folder in which it lies: runs it, reads it or builds it."""
    name = saved.value("file")
    used = name.partition("/")[0]
    others = "".join(block.text for block in page.blocks if block is not saved)
    return page.name in COMPILED_BY or re.search(rf"\b{re.escape(used)}\b", others)


def quotes(block, all_pages):
    """Whether all lines of a block of CMake are those of one that is run."""
    whole = [other.text.splitlines() for page in all_pages for other in page.blocks
             if other.language == "cmake" and other.is_saved]
    return any(set(block.text.splitlines()) <= set(lines) for lines in whole)


def wrong_blocks(page, all_pages, root):
    for block in page.blocks:
        place = f"{page.name}:{block.line}"
        reason = block.value("norun")
        if block.language not in LANGUAGES:
            yield f"{place}: a block of {block.language or 'no language'}: one of {sorted(LANGUAGES)}"
        if reason is not None and reason not in REASONS:
            yield f"{place}: no reason: {reason}: one of {sorted(REASONS)}"
        if block.value("needs") not in {None, *PACKAGES}:
            yield f"{place}: no test has {block.value('needs')}: one of {sorted(PACKAGES)}"
        unknown = [word for word in block.words if not re.match("norun=|file=|needs=|output$", word)]
        if unknown:
            yield f"{place}: what is {unknown}?"
        if not block.is_run:
            problem = bad_syntax(block)
            if problem:
                yield f"{place}: {problem}"
        for name in missing_files(block, page, root):
            yield f"{place}: there is no {name}"
        if block.is_saved and not is_used(block, page):
            yield f"{place}: nothing uses {block.value('file')}"
        if block.language == "cmake" and not block.is_saved and not quotes(block, all_pages):
            yield f"{place}: this CMake stands in no CMakeLists.txt that is run"


def check(root):
    all_pages = pages(root)
    wrong = []
    for page in all_pages:
        wrong += [*indented_code(page), *wrong_blocks(page, all_pages, root)]
    left_out, kinds = collections.defaultdict(list), collections.Counter()
    for page in all_pages:
        for block in page.blocks:
            reason = block.value("norun")
            if reason:
                left_out[reason].append(f"{page.name}:{block.line}")
            kinds[f"{block.language}{', not run' if reason else ''}"] += 1
    print("blocks:", ", ".join(f"{count} {kind}" for kind, count in sorted(kinds.items())))
    for name, test in ELSEWHERE.items():
        print(f"run by {test}: {name}")
    for reason, places in sorted(left_out.items()):
        print(f"not run, as this {REASONS.get(reason)}: {', '.join(places)}")
        if len(places) > MOST.get(reason, 0):
            wrong.append(f"{len(places)} blocks with norun={reason}: more than {MOST.get(reason, 0)}")
    print("\n".join(wrong))
    return 1 if wrong else 0


def main():
    with repository_copy(sys.argv[1]) as root:
        return check(root)


if __name__ == "__main__":
    sys.exit(main())
