#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the documentation promise to those in whose folder they run: test_runner.py BUILD"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from repository_copy import all_files, copy_repository, repository_files

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv.pop(1)).resolve()

# What tutorials and users leave in the folder: the names are those that pages and givens.py use.
PLANTED = [
    "scan.ply", "scan.vtp", "scan.raw", "coarse.ply", "reference.ply", "mesh.ply", "mesh.vtp", "jobs.json",
    "jobs-results/summary.csv", "scans/scan.ply", "prefix/bin/neuralmesh", "program/program.cxx",
    "packages/notes.txt", "Documentation/Pictures/mine.png",
]
NOTES = """# Notes

There is [nothing](nowhere.md) here, nor in `Filters/nothing.h`.

```sh
false
```

```cpp
nothing;
```
"""
SESSION = """# A session

```sh
echo "no mesh" > mesh.ply
export WORD=kept
mkdir further
cd further
```

```sh
echo "$WORD ${PWD##*/} ${PYTHONPATH-unset} ${PV_PLUGIN_CONFIG_FILE-unset}"
case :$PATH: in *:BUILD/bin:*) echo "the build is on the path" ;; esac
```

```text output
kept further unset unset
```
"""


def git(folder, *arguments):
    environment = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
    subprocess.run(["git", "-C", folder, *arguments], env=environment, check=True, capture_output=True)


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


class InFolder(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name).resolve()


class Files(InFolder):
    def setUp(self):
        super().setUp()
        for name in ("README.md", "Folder/file.txt", "Folder/gone.txt"):
            write(self.folder / name, "committed")

    def track(self):
        git(self.folder, "init", "--quiet")
        git(self.folder, "add", "--all")
        write(self.folder / "scan.ply", "mine")
        write(self.folder / "README.md", "edited")
        (self.folder / "Folder" / "gone.txt").unlink()

    def names(self):
        return [path.as_posix() for path in repository_files(self.folder)]

    # Promise: a copy has what git tracks, as it is in the working tree, and nothing else, also within a
    # hook of another repository.
    @unittest.skipUnless(shutil.which("git"), "needs git")
    def test_tracked(self):
        self.track()
        os.environ["GIT_DIR"] = "/nowhere"
        self.addCleanup(os.environ.pop, "GIT_DIR")
        with tempfile.TemporaryDirectory() as name:
            copy = pathlib.Path(name)
            copy_repository(self.folder, copy)
            copied = {path.relative_to(copy).as_posix() for path in copy.rglob("*") if path.is_file()}
            self.assertEqual(copied, {"README.md", "Folder/file.txt"})
            self.assertEqual((copy / "README.md").read_text(encoding="utf-8"), "edited")
            write(copy / "README.md", "changed in the copy")
        self.assertEqual((self.folder / "README.md").read_text(encoding="utf-8"), "edited")

    # Promise: so it is where the folder belongs to another user.
    @unittest.skipUnless(shutil.which("git") and os.geteuid() == 0, "needs git, and root")
    def test_of_another_user(self):
        self.track()
        for path in (self.folder, self.folder / ".git"):
            os.chown(path, 12345, 12345)
        self.assertEqual(self.names(), ["Folder/file.txt", "README.md"])

    # Promise: where git has no answer, what is built or made by scripts is left out.
    def test_without_git(self):
        for name in (".git", ".hidden/a", "build/a", "build-wheel/a", "demo/a", "packages/a", "Folder/__pycache__/a"):
            write(self.folder / name, "made")
        write(self.folder / "Folder" / "demo" / "file.txt", "committed")
        expected = ["Folder/demo/file.txt", "Folder/file.txt", "Folder/gone.txt", "README.md"]
        self.assertEqual([name for name in self.names() if name != ".git"], expected)


@unittest.skipUnless(shutil.which("git"), "needs git, to know what is a user's")
class Planted(InFolder):
    def setUp(self):
        super().setUp()
        copy_repository(ROOT, self.folder)
        git(self.folder, "init", "--quiet")
        git(self.folder, "add", "--all")
        self.plant()

    def edit(self, name, change):
        before = (self.folder / name).read_text(encoding="utf-8")
        self.assertNotEqual(change(before), before)
        write(self.folder / name, change(before))

    def plant(self):
        for name in PLANTED:
            write(self.folder / name, f"the user's {name}")
        for name in ("notes.md", "Documentation/notes.md"):
            write(self.folder / name, NOTES)

    def snapshot(self):
        return {
            path: (path.stat().st_mtime_ns, path.read_bytes())
            for path in (self.folder / name for name in all_files(self.folder))
        } | {self.folder / name: (self.folder / name).read_bytes() for name in PLANTED}

    def start(self, script, *arguments):
        environment = {
            **os.environ,
            "PATH": f"{BUILD / 'bin'}:{os.environ['PATH']}",
            "PV_PLUGIN_CONFIG_FILE": "set",
            "PYTHONDONTWRITEBYTECODE": "1",
        }
        return subprocess.Popen(
            [sys.executable, self.folder / "Testing" / "Documentation" / script, self.folder, *arguments],
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )

    def finish(self, process):
        printed = process.communicate()[0]
        self.assertEqual(process.returncode, 0, printed)
        return printed

    # Promise: nothing in the folder of the repository is changed or added when pages run, and what a
    # user keeps there changes nothing for them; the blocks of shell are one session, to which only the
    # page has shown what was built.
    def test_pages(self):
        # Of the batch, what is quick.
        recipe = '"matrix": {"vertices": 200}, "gallery": false,'
        self.edit("Documentation/Guide/CommandLine.md", lambda text: re.sub('"matrix": .*', recipe, text))
        write(self.folder / "Documentation" / "Session.md", SESSION.replace("BUILD", str(BUILD)))
        before = self.snapshot()
        names = ("README", "Documentation/Guide/CommandLine", "Documentation/Session")
        processes = {name: self.start("run_blocks.py", BUILD, f"{name}.md") for name in names}
        for name, process in processes.items():
            with self.subTest(page=name):
                self.finish(process)
        self.assertEqual([path for path, state in self.snapshot().items() if before.get(path) != state], [])
        self.assertEqual(before.keys(), self.snapshot().keys())

    # Promise: nor do pages and pictures of a user's own break the checks, or become tests.
    def test_checks(self):
        for script in ("check_links.py", "check_pictures.py", "markdown_pages.py"):
            with self.subTest(script=script):
                self.assertNotIn("notes.md", self.finish(self.start(script)))
        program = self.folder / "build" / "blocks.cxx"
        program.parent.mkdir()
        self.finish(self.start("write_cpp.py", program))
        self.assertNotIn("nothing;", program.read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
