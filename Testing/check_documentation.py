#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whether the documentation holds together: check_documentation.py ROOT

Every relative link leads to a file, every file named in Documentation/Thesis.md exists, and no cell
of its tables is empty. Prints what does not hold.
"""

import pathlib
import re
import sys


def bad_links(page):
    for target in re.findall(r"\]\(([^)#]+)[^)]*\)", page.read_text(encoding="utf-8")):
        if "://" not in target and not (page.parent / target).exists():
            yield f"{page}: there is no {target}"


def bad_cells(root, page):
    rows = [line for line in page.read_text(encoding="utf-8").splitlines() if line.startswith("|")]
    if len(rows) < 10:
        yield f"{page}: no table"
    for row in rows:
        cells = [cell.strip() for cell in row.strip("|").split("|")]
        if not all(cells):
            yield f"{page}: an empty cell in {row}"
        for name in re.findall(r"`([\w./]+\.(?:h|cpp|cxx|py|sh|md))`", row):
            if not any(root.glob(f"*/**/{name}")):
                yield f"{page}: there is no file {name}"


def main():
    root = pathlib.Path(sys.argv[1])
    pages = [*root.glob("*.md"), *root.glob("[A-Z]*/**/*.md")]
    wrong = [text for page in pages for text in bad_links(page)]
    wrong += bad_cells(root, root / "Documentation" / "Thesis.md")
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
