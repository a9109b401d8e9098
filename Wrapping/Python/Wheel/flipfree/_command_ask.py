"""`flipfree segment --ask`: puts the questions of a result to whoever sits at the terminal."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from ._questions import Question


def ask(questions: Sequence[Question], nothing_to_ask: str) -> dict[int, bool]:
    """The answers by the numbers of the questions; none of those that are skipped."""
    if not questions:
        print(nothing_to_ask, end="", file=sys.stderr)
    answers: dict[int, bool] = {}
    for number, question in enumerate(questions):
        answer = _answer_to(f"{question} [y/n, Enter: skip] ")
        if answer is None:
            break
        if answer:
            answers[number] = answer[0] == "y"
    return answers


def _answer_to(question: str) -> str | None:
    """Asks again until the answer is one; None at the end of the input."""
    while True:
        print(question, end="", file=sys.stderr, flush=True)
        line = sys.stdin.readline()
        if not line:
            print(file=sys.stderr)
            return None
        answer = line.strip().lower()
        if answer in ("", "y", "yes", "n", "no"):
            return answer
