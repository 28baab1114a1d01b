#!/usr/bin/env bash
# Every test has one label that tells when it runs: check_labels.sh BUILD
set -euo pipefail
cd "$1"
# Of a program that is not built, as with sanitizers, there is a place-holder.
ctest --show-only=json-v1 | python3 -c '
import json, re, sys

wrong = []
for test in json.load(sys.stdin)["tests"]:
    properties = {item["name"]: item["value"] for item in test.get("properties", [])}
    labels = properties.get("LABELS", [])
    if len(labels) != 1 or not re.fullmatch("(fast|full|sanitized|nightly)(-threads)?", labels[0]):
        wrong.append((test["name"], labels))
wrong = [name for name in wrong if not name[0].endswith("_NOT_BUILT")]
for name, labels in wrong:
    print(name, "has the labels", labels)
sys.exit(1 if wrong else 0)
'
