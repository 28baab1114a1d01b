#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whether the site of the documentation stands by itself: check_site.py SITE

Every local link leads to a file and, behind a #, to a place in it; pictures, scripts, styles and frames are files
of the site, and styles take nothing from elsewhere. Prints what does not hold.
"""

import functools
import html.parser
import pathlib
import re
import sys
import urllib.parse

# What a browser fetches by itself, and what it does not.
FETCHED = {"script": "src", "img": "src", "iframe": "src", "source": "src", "embed": "src", "object": "data"}
FETCHED_LINKS = {"stylesheet", "icon", "preload", "modulepreload", "manifest", "shortcut icon"}
ELSEWHERE = re.compile(r"(?:[a-z]+:)?//")


class Reader(html.parser.HTMLParser):
    """Gathers the places of a page, its links, and what it fetches."""

    def __init__(self):
        super().__init__()
        self.places, self.links, self.fetched = set(), [], []

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.places |= {attributes[name] for name in ("id", "name") if attributes.get(name)}
        target = attributes.get("href")
        if tag == "link" and attributes.get("rel") in FETCHED_LINKS:
            self.fetched.append(target)
        elif tag in ("a", "area", "link") and target:
            self.links.append(target)
        if tag in FETCHED and attributes.get(FETCHED[tag]):
            self.fetched.append(attributes[FETCHED[tag]])


@functools.cache
def read(path):
    reader = Reader()
    reader.feed(path.read_text(encoding="utf-8"))
    return reader


def bad_target(page, target):
    """What is wrong with a local link, None if nothing is."""
    address = urllib.parse.urlsplit(target)
    path = (page.parent / urllib.parse.unquote(address.path)).resolve() if address.path else page
    if not path.is_file():
        return f"there is no {target}"
    place = urllib.parse.unquote(address.fragment)
    # Doxygen links to the list of private classes, too, which it leaves out.
    is_known = place in read(path).places or place == "nested-classes" if path.suffix == ".html" else True
    if place and not is_known:
        return f"there is no place for {target}"
    return None


def bad_page(page):
    reader = read(page)
    for target in reader.fetched:
        if ELSEWHERE.match(target):
            yield f"{target} is fetched from elsewhere"
    for target in (*reader.links, *reader.fetched):
        is_local = not re.match(r"[a-z]+:|//", target)
        wrong = bad_target(page, target) if is_local else None
        if wrong:
            yield wrong


def bad_styles(path):
    for target in re.findall(r"(?:url\(|@import)\s*[\"']?([^\"')\s]+)", path.read_text(encoding="utf-8")):
        if ELSEWHERE.match(target):
            yield f"{target} is fetched from elsewhere"


def main():
    site = pathlib.Path(sys.argv[1]).resolve()
    if not (site / "index.html").exists():
        print("skipped: there is no site; cmake --build build --target site makes it")
        return 0
    pages = sorted(site.rglob("*.html"))
    wrong = [f"{page.relative_to(site)}: {text}" for page in pages for text in bad_page(page)]
    wrong += [f"{path.relative_to(site)}: {text}" for path in site.rglob("*.css") for text in bad_styles(path)]
    links = sum(len(read(page).links) for page in pages)
    print("\n".join(wrong) or f"{len(pages)} pages, {links} links: all well")
    return 1 if wrong or links < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
