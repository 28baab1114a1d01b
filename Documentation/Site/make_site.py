#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the site of the documentation: make_site.py BUILD

BUILD is a build tree that has the reference of the classes and the package of pip. The site is BUILD/site,
its first page BUILD/site/index.html. What makes it comes from PyPI, into BUILD/Documentation/Site.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import venv

SITE = pathlib.Path(__file__).resolve().parent
REPOSITORY = SITE.parent.parent
REQUIREMENTS = SITE / "requirements.txt"


def python_with_packages(folder):
    """A Python that has the packages of requirements.txt."""
    python, installed = folder / "bin" / "python", folder / "installed.txt"
    wanted = REQUIREMENTS.read_text()
    if not installed.exists() or installed.read_text() != wanted:
        venv.create(folder, clear=True, with_pip=True)
        pip = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
        if subprocess.run([*pip, "--requirement", REQUIREMENTS]).returncode:
            sys.exit("The site is not made: pip could not install what Documentation/Site/requirements.txt names.\n"
                     "Is PyPI reached from here? What pip says stands above.")
        installed.write_text(wanted)
    return python


def gather_pages(sources):
    """The pages and their pictures, in one folder as in the repository; the first page has the contents."""
    documentation = sources / "Documentation"
    ignored = shutil.ignore_patterns("Site", "Gallery", "*.in", "*.txt", "__pycache__")
    shutil.copytree(REPOSITORY / "Documentation", documentation, ignore=ignored)
    shutil.copytree(SITE / "Reference", sources / "Reference")
    for name in ("CHANGELOG.md", "CONTRIBUTING.md"):
        shutil.copy(REPOSITORY / name, sources)
    (sources / "index.md").write_text((REPOSITORY / "README.md").read_text() + "".join(contents(sources)))


def gather_made(build, sources):
    """What the build tree has: the page of parameters with its tables, and the reference of the classes."""
    page = pathlib.Path("Documentation", "Guide", "Parameters.md")
    shutil.copy(build / page, sources / page)
    shutil.copytree(build / "reference" / "html", sources / "extra" / "classes")


def contents(sources):
    """Tables of contents: the sections of the index, and what is made."""
    index = sources / "Documentation" / "README.md"
    left = {path.relative_to(sources).as_posix() for path in sources.rglob("*.md")}
    left.discard("Documentation/README.md")
    yield toctree("", ["Documentation/README.md"])
    for section in re.split(r"^## ", index.read_text(), flags=re.MULTILINE)[1:]:
        pages = []
        for link in re.findall(r"\]\(([^)#]+)", section):
            page = os.path.relpath(index.parent / link, sources)
            if page in left:
                left.remove(page)
                pages.append(page)
        yield toctree(section.splitlines()[0], pages)
    yield toctree("Examples and reference", ["Gallery/index", "Reference/Python", "Reference/Cpp"])
    yield toctree("More", sorted(left))


def toctree(caption, pages):
    lines = ["", "```{toctree}", ":hidden:", ":maxdepth: 1"]
    if caption:
        lines.append(f":caption: {caption}")
    return "\n".join([*lines, "", *pages, "```", ""]) if pages else ""


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    folder = build / "Documentation" / "Site"
    python = python_with_packages(folder / "venv")
    sources, site = folder / "source", build / "site"
    for old in (sources, site):
        shutil.rmtree(old, ignore_errors=True)
    gather_pages(sources)
    gather_made(build, sources)
    environment = dict(os.environ, PYTHONPATH=str(build / "lib" / "python3-engine"))
    command = [
        python, "-m", "sphinx", "--builder", "html", "--fresh-env", "--fail-on-warning", "--keep-going", "--quiet",
        "--conf-dir", SITE, "--doctree-dir", folder / "doctrees",
        "--define", f"html_extra_path={sources / 'extra'}", sources, site,
    ]  # fmt: skip
    sphinx = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if sphinx.returncode:
        sys.exit(f"{sphinx.stdout}\nThe site is not made: what Sphinx complains of stands above.")
    print(f"The site: {site / 'index.html'}")


if __name__ == "__main__":
    main()
