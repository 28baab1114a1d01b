# SPDX-License-Identifier: BSD-3-Clause
"""Promise: the tag of each warning is a heading of Guide/Failures.md, and each third-level heading there is such a
tag: check_warnings.py REPOSITORY
"""

import re
import sys
from pathlib import Path


def main(root):
    source = (root / "Filters/Core/base/WarningTopic.cpp").read_text(encoding="utf-8")
    tags = re.findall(r'string_view\("([a-z-]+)"\)', source)
    page = root / "Documentation/Guide/Failures.md"
    headings = re.findall(r"^### (.+)$", page.read_text(encoding="utf-8"), re.M)
    anchors = [heading.lower().replace(" ", "-") for heading in headings]
    problems = [f"the tag {tag} is no heading" for tag in sorted(set(tags) - set(anchors))]
    problems += [f"the heading {anchor} is no tag" for anchor in sorted(set(anchors) - set(tags))]
    if not tags or len(set(tags)) < len(tags):
        problems.append("tags are missing in WarningTopic.cpp, or are there twice")
    for problem in problems:
        print(f"{page}: {problem}")
    return bool(problems)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
