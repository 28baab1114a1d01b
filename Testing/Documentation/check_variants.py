#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whether the section of each variant has the same form: check_variants.py ROOT

What it is for comes first, then how it is done in one block of shell, a picture, what it costs, and where it
comes from. Prints what is missing.
"""

import re
import sys

from markdown_pages import Block, Page
from repository_copy import repository_copy

PAGE = "Documentation/Research/Variants.md"
VARIANTS = ["Noise filtering", "Basic", "Normal-based", "Topology rules", "Ensembles"]
# Values of all of them: nothing that a picture could show.
PRESET = "Thesis preset"
FORM = ["Purpose:", "sh", "**Cost.**", "**Source.**"]


def sections(page):
    """The parts of the page below each heading of the second level."""
    found, title = {}, None
    for part in page.parts:
        if not isinstance(part, Block) and part[1].startswith("## "):
            title = part[1][3:]
            found[title] = []
        elif title is not None:
            found[title].append(part)
    return found


def marks(parts):
    """Which parts of the form a section has, in its order."""
    for part in parts:
        if isinstance(part, Block):
            yield part.language
        else:
            yield from (mark for mark in FORM if part[1].startswith(mark) and part[1] != mark)


def missing(title, parts):
    found = list(marks(parts))
    if found != FORM:
        yield f"{title}: {FORM}, each once and in this order, not {found}"
    text = "\n".join(part[1] for part in parts if not isinstance(part, Block))
    if title != PRESET and not re.search(r"!\[[^]]+\]\(", text):
        yield f"{title}: a picture"


def check(root):
    found = sections(Page(root / PAGE, PAGE))
    wrong = [text for title, parts in found.items() for text in missing(title, parts)]
    if list(found) != [*VARIANTS, PRESET]:
        wrong.append(f"sections: {[*VARIANTS, PRESET]}, not {list(found)}")
    print("\n".join(wrong) or f"{len(found)} sections: all well")
    return 1 if wrong else 0


def main():
    with repository_copy(sys.argv[1]) as root:
        return check(root)


if __name__ == "__main__":
    sys.exit(main())
