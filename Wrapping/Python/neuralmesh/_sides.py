# SPDX-License-Identifier: BSD-3-Clause
"""What a report says about the outer side of a mesh."""

from __future__ import annotations

_SHARE_TOLD = 0.0001


def sides_text(oriented_by: str, unoriented_share: float, guessed_share: float) -> str:
    """What determines the outer side, and of what share of the area it is unknown."""
    is_unknown, is_guessed = unoriented_share > 0.5, guessed_share > 0.5
    text = "unknown" if is_unknown else f"by {oriented_by}"
    if is_guessed:
        text += ", a guess"
    if not is_unknown and unoriented_share > _SHARE_TOLD:
        text += f", {100.0 * unoriented_share:.2g} % of the area unknown"
    if is_unknown or is_guessed:
        text += ", most looks up, along z, or to what stands on it;" if is_unknown else ";"
        text += " --viewpoint or --up may determine them"
    return text
