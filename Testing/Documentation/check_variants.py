#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whether the page of each variant has the same form: check_variants.py ROOT

What it is for comes first, then a picture, how it is done in C++, Python and shell, what it costs, and
where it comes from. The index has them all. Prints what is missing.
"""

import re
import sys

from markdown_pages import Page
from repository_copy import repository_copy

HEADINGS = ["How", "What it costs", "Source"]
LANGUAGES = {"cpp", "python", "sh"}


def variants(index):
    """The pages in the table of the index that begins with `page` and `for`."""
    text = index.path.read_text(encoding="utf-8")
    table = re.search(r"\| page \| for \|\n\|---\|---\|\n((?:\|.*\n)+)", text)[1]
    return re.findall(r"\]\((\w+\.md)\)", table)


def missing(page):
    headings = [line[3:] for _, line in page.prose if line.startswith("## ")]
    if [heading for heading in headings if heading in HEADINGS] != HEADINGS:
        yield f"{page.name}: the headings {HEADINGS}, in this order"
    if not page.pictures:
        yield f"{page.name}: a picture"
    for language in LANGUAGES - {block.language for block in page.blocks}:
        yield f"{page.name}: how it is done in {language}"


def check(root):
    folder = root / "Documentation"
    names = variants(Page(folder / "README.md", "README.md"))
    wrong = [text for name in names for text in missing(Page(folder / name, name))]
    print("\n".join(wrong) or f"{len(names)} variants: all well")
    return 1 if wrong or len(names) < 9 else 0


def main():
    with repository_copy(sys.argv[1]) as root:
        return check(root)


if __name__ == "__main__":
    sys.exit(main())
