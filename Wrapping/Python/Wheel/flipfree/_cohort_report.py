"""The report of a cohort: one HTML file that needs no other, to look through the results."""

from __future__ import annotations

import base64
import os
from html import escape
from typing import Any

from ._messages import confidence_text, counted

# Rows whose picture is in the file; those behind them, of the highest confidence, refer to theirs.
PICTURES = 1000
# Rows that are listed; a browser is slow with more.
LISTED = 10000

STYLE = """
body { margin: 0; padding: 1.5rem; background: #16181d; color: #d9dbe0; font: 15px/1.45 system-ui, sans-serif; }
h1 { margin: 0 0 .3rem; font-size: 1.5rem; }
p { margin: 0 0 1rem; color: #a5abb8; max-width: 60rem; }
main { display: grid; grid-template-columns: repeat(auto-fill, minmax(19rem, 1fr)); gap: 1rem; }
article { background: #22252d; border-radius: 6px; overflow: hidden; }
img { display: block; width: 100%; aspect-ratio: 1; }
h2 { margin: .6rem .8rem .2rem; font-size: 1rem; overflow-wrap: anywhere; }
dl { display: grid; grid-template-columns: auto 1fr; gap: 0 .8rem; margin: 0 .8rem .7rem; }
dt { color: #a5abb8; }
dd { margin: 0; overflow-wrap: anywhere; }
.failed { outline: 2px solid #e0604c; }
.message { margin: 0 .8rem .7rem; color: #ffc233; }
.failed .message { color: #ff8d7a; }
"""


def report_of(rows: list[dict[str, Any]], folder: str) -> str:
    """The file's text; failed rows first, then those of the least confidence, and label maps last."""
    ordered = sorted(
        rows, key=lambda row: (row["status"] == "done", bool(row["surfaces"]), row["confidence"] or 0.0)
    )
    failed = sum(row["status"] != "done" for row in rows)
    noun = "row" if len(rows) == 1 else "rows"
    cards = [
        _card(row, f"{index + 1}", folder if index < PICTURES else None)
        for index, row in enumerate(ordered[:LISTED])
    ]
    more = f" The file lists the first {LISTED:,} of them; cohort.csv has all." if len(rows) > LISTED else ""
    return "\n".join(
        (
            '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<title>FlipFree: a cohort of {len(rows)} {noun}</title>\n<style>{STYLE}</style>\n</head>\n<body>",
            f"<h1>{len(rows):,} {noun}, {failed:,} failed</h1>",
            "<p>Failed rows come first, then those of the least confidence, which reads like the Dice score to "
            "expect; below 0.85 a result is doubtful. Pictures: axial, sagittal and coronal slices through the "
            "surface's center, their contour blue where the image does not support it, and the surface from "
            f"the front.{more}</p>\n<main>",
            *cards,
            "</main>\n</body>\n</html>\n",
        )
    )


def _card(row: dict[str, Any], title: str, folder: str | None) -> str:
    names = [row[column] for column in ("case", "organ") if row.get(column)] or [_file_of(row)]
    parts = [f'<article class="{escape(row["status"])}">']
    if row["picture"]:
        source = row["picture"] if folder is None else _inlined(os.path.join(folder, row["picture"]))
        parts.append(f'<a href="{escape(row["picture"])}"><img loading="lazy" alt="" src="{escape(source)}"></a>')
    parts.append(f"<h2>{title}. {escape(' '.join(names))}</h2>")
    if row["message"]:
        parts.append(f'<div class="message">{escape(row["message"])}</div>')
    facts = "".join(f"<dt>{name}</dt><dd>{escape(text)}</dd>" for name, text in _facts(row).items())
    return "\n".join([*parts, f"<dl>{facts}</dl>", "</article>"])


def _facts(row: dict[str, Any]) -> dict[str, str]:
    if row["status"] != "done":
        return {"label map" if row.get("label_map") else "volume": _file_of(row)}
    if row["surfaces"]:  # of a label map
        return {
            "surfaces": row["surfaces"],
            "volume": f"{row['segmented_ml']:.1f} ml",
            "seconds": f"{row['seconds']:.1f}",
        }
    facts = {}
    if row["confidence"] is not None:  # vessels have none
        facts["confidence"] = confidence_text(row["confidence"])
    if row["first_question"]:
        facts["questions"] = f"{row['questions']}, the first at {row['first_question']} mm"
    if row["dice"] is not None:
        facts["Dice"] = f"{row['dice']:.3f}"
        facts["distance"] = f"{row['asd_mm']:.2f} mm in the mean, 95 % within {row['hd95_mm']:.1f} mm"
    return {
        **facts,
        "volume": f"{row['segmented_ml']:.1f} ml",
        "stopped": f"{row['stop_reason']}, {counted(row['iterations'], 'iteration')}",
        "seconds": f"{row['seconds']:.1f}",
    }


def _file_of(row: dict[str, Any]) -> str:
    return str(row.get("volume") or row.get("label_map") or "")


def _inlined(path: str) -> str:
    """A picture as a part of the text."""
    try:
        with open(path, "rb") as file:
            return "data:image/jpeg;base64," + base64.b64encode(file.read()).decode()
    except OSError:
        return ""
