#!/usr/bin/env bash
# Draws the pictures of the page for Python and PyVista anew, by doing what it says: draw_pyvista.sh [PYTHON], a Python
# that has NeuralMesh and PyVista. Without it, one is made, for which NeuralMesh is compiled.
set -euo pipefail
cd "$(dirname "$0")/../.."
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python=${1:-}
if [ -z "$python" ]; then
  # Else the package of a build tree would be found before it.
  unset PYTHONPATH
  python3 -m venv "$folder/venv"
  python=$folder/venv/bin/python
  "$python" -m pip install --quiet . pyvista
fi

"$python" - "$PWD" "$folder" <<'END'
import os
import pathlib
import sys

root, folder = (pathlib.Path(path) for path in sys.argv[1:])
sys.path.insert(0, str(root / "Testing" / "Documentation"))
from markdown_pages import Page
from PIL import Image

page = Page(root / "Documentation" / "Guide" / "Python.md", "Python.md")
os.chdir(folder)
variables = {}
for block in page.blocks:
    if block.language == "python":
        exec(block.text, variables)
for path in folder.glob("pyvista_*.png"):
    Image.open(path).convert("RGB").save(root / "Documentation" / "Pictures" / path.name, optimize=True)
END
