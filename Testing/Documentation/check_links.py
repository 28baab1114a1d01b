#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whether the documentation leads nowhere in vain: check_links.py ROOT

Every relative link leads to a file and, behind a #, to a heading; every file that prose names in code
font with its folder exists; every page of Documentation is linked from its index; every file named in
Thesis.md exists, and no cell of its tables is empty. Prints what does not hold.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from markdown_pages import pages
from repository_copy import repository_copy

# A path from the root of the repository, in code font.
FOLDERS = "Applications|CMake|Data|Documentation|Filters|Laboratory|Testing|Utilities|Wrapping"
NAMED_FILE = re.compile(rf"`((?:{FOLDERS})/[\w./-]+\.\w+)`")


def bad_links(page, by_path):
    for link in page.links:
        target, _, anchor = link.partition("#")
        path = (page.path.parent / target).resolve() if target else page.path.resolve()
        if "://" in link or link.startswith("mailto:"):
            continue
        if not path.exists():
            yield f"{page.name}: there is no {target}"
        elif anchor and (path not in by_path or anchor not in by_path[path].anchors):
            yield f"{page.name}: there is no heading for {link}"


def bad_names(page, root):
    for number, line in page.prose:
        for name in NAMED_FILE.findall(line):
            if not (root / name).exists():
                yield f"{page.name}:{number}: there is no file {name}"


def not_in_index(all_pages):
    (index,) = (page for page in all_pages if page.name == "Documentation/README.md")
    linked = {(index.path.parent / link.partition("#")[0]).resolve() for link in index.links}
    for page in all_pages:
        if page.path.is_relative_to(index.path.parent) and page is not index and page.path.resolve() not in linked:
            yield f"{index.name}: {page.name} is not linked"


def bad_cells(root, page):
    rows = [line for line in page.lines if line.startswith("|")]
    if len(rows) < 10:
        yield f"{page.name}: no table"
    for row in rows:
        cells = [cell.strip() for cell in row.strip("|").split("|")]
        if not all(cells):
            yield f"{page.name}: an empty cell in {row}"
        for name in re.findall(r"`([\w./]+\.(?:h|cpp|cxx|py|sh|md))`", row):
            if not any(root.glob(f"*/**/{name}")):
                yield f"{page.name}: there is no file {name}"


def check(root):
    all_pages = pages(root)
    by_path = {page.path: page for page in all_pages}
    wrong = [text for page in all_pages for text in (*bad_links(page, by_path), *bad_names(page, root))]
    wrong += not_in_index(all_pages)
    (thesis,) = (page for page in all_pages if page.path.name == "Thesis.md")
    wrong += bad_cells(root, thesis)
    print("\n".join(wrong) or f"{sum(len(page.links) for page in all_pages)} links: all well")
    return 1 if wrong else 0


def put_tables(root):
    """Makes the page of parameters what it is in the build tree, tables and all."""
    generate = root / "CMake" / "Parameters" / "generate.py"
    with tempfile.TemporaryDirectory() as build:
        subprocess.run([sys.executable, generate, root, build], check=True, stdout=subprocess.DEVNULL)
        page = pathlib.Path("Documentation", "Guide", "Parameters.md")
        shutil.copy(build / page, root / page)


def main():
    with repository_copy(sys.argv[1]) as root:
        put_tables(root)
        return check(root)


if __name__ == "__main__":
    sys.exit(main())
