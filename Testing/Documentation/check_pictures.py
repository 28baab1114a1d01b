#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whether every picture of the documentation has one maker and a page: check_pictures.py ROOT

`Documentation/Pictures/draw.sh --list` names each picture once, beside what draws it; what a page shows
is there, has words for who cannot see it, and no picture is left that no page shows.
"""

import collections
import re
import subprocess
import sys

from markdown_pages import pages
from repository_copy import repository_copy


def listed(folder):
    lines = subprocess.run(
        ["bash", folder / "draw.sh", "--list"], check=True, capture_output=True, text=True
    ).stdout.splitlines()
    return [line.split() for line in lines]


def wrong_makers(folder, makers):
    counts = collections.Counter(name for _, name in makers)
    yield from (f"{name}: {count} makers" for name, count in counts.items() if count > 1)
    for maker, name in makers:
        text = (folder / maker).read_text(encoding="utf-8")
        # The pictures of the tutorial are known by its page.
        if maker.endswith(".py") and not re.search(rf"def (draw_)?{name}\(|\"{name}\":", text):
            yield f"{name}: {maker} does not draw it"
    files = {path.stem for path in folder.glob("*.png")}
    yield from (f"{name}: draw.sh does not know it" for name in files - set(counts))
    yield from (f"{name}: there is no such picture; bash Documentation/Pictures/draw.sh {name}"
                for name in set(counts) - files)


def wrong_uses(root, folder):
    used = set()
    for page in pages(root):
        for target in page.pictures:
            path = (page.path.parent / target).resolve()
            used.add(path)
            if not path.exists():
                yield f"{page.name}: there is no picture {target}"
        if "![](" in "\n".join(page.lines):
            yield f"{page.name}: a picture without words"
    yield from (f"{path.name}: no page shows it" for path in folder.glob("*.png") if path not in used)


def check(root):
    folder = root / "Documentation" / "Pictures"
    makers = listed(folder)
    wrong = [*wrong_makers(folder, makers), *wrong_uses(root, folder)]
    print("\n".join(wrong) or f"{len(makers)} pictures: all well")
    return 1 if wrong else 0


def main():
    with repository_copy(sys.argv[1]) as root:
        return check(root)


if __name__ == "__main__":
    sys.exit(main())
