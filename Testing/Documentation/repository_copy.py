# SPDX-License-Identifier: BSD-3-Clause
"""The files of the repository, and copies of them for tests to work on.

Beside its files the folder of the repository may hold what a user keeps there, scans, meshes, notes:
tests neither read nor write any of that. The repository's are the files that git tracks, with the
contents that they have in the working tree, so that edits count before they are committed, and new files
from `git add` on. Where git has no answer (an unpacked archive, a chroot without git) they are all files
but those in folders that builds and scripts make, and in hidden ones.
"""

import contextlib
import os
import pathlib
import shutil
import subprocess
import tempfile

# In the root, beside build*; those of .gitignore.
MADE_BY_SCRIPTS = {"demo", "laboratory", "nightly", "out", "packages"}


def tracked_files(root):
    """What git tracks, relative to the root; None where git does not say."""
    if not (root / ".git").exists():
        return None
    # Within a hook, variables of git stand for the repository of the hook.
    environment = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
    # The folder may belong to somebody else than who runs the tests.
    command = ["git", "-c", "safe.directory=*", "-C", root, "ls-files", "-z"]
    try:
        process = subprocess.run(command, env=environment, capture_output=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return None
    return [pathlib.Path(name) for name in os.fsdecode(process.stdout).split("\0") if name]


def all_files(root):
    """All files but those that somebody or something else has made for sure, relative to the root."""
    for folder, folders, names in os.walk(root):
        place = pathlib.Path(folder).relative_to(root)
        hidden = {name for name in folders if name.startswith(".") or name == "__pycache__"}
        made = {name for name in folders if name.startswith("build") or name in MADE_BY_SCRIPTS}
        folders[:] = set(folders) - hidden - (made if place == pathlib.Path() else set())
        yield from (place / name for name in names)


def repository_files(root):
    """The files of the repository, relative to its root, in order."""
    root = pathlib.Path(root)
    # What is tracked may have been removed.
    return sorted(path for path in tracked_files(root) or all_files(root) if os.path.lexists(root / path))


def copy_repository(root, folder):
    """Copies the files of the repository into a folder."""
    for path in repository_files(root):
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(root / path, folder / path, follow_symlinks=False)


@contextlib.contextmanager
def repository_copy(root):
    """A copy of the repository in a temporary folder."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name).resolve()
        copy_repository(pathlib.Path(root), folder)
        yield folder
