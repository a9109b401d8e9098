"""`flipfree segment --ask`: puts the questions of a result to whoever sits at the terminal."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

from ._options import WrongUsage
from ._questions import Question
from ._segment import default_parameters


def require_answers(values: dict[str, Any]) -> None:
    """There is somebody to answer, and one organ that the answers correct."""
    if {"organ", "fixed", "session"} & values.keys():
        raise WrongUsage(
            "--ask is for one organ, which starts from a seed or --start-labels. Leave it out; "
            "--questions writes the questions of several"
        )
    if not sys.stdin or not sys.stdin.isatty():
        raise WrongUsage(
            "--ask needs a terminal to ask at. Write the questions to a file by --questions, and "
            "answer them by --inside and --outside"
        )


def say_nothing_to_ask(values: dict[str, Any]) -> None:
    """Why there are no questions."""
    if "start_labels" in values:
        why = "a start from labels has no questions"
    elif {**default_parameters(values.get("preset", "default")), **values}["carving"]:
        why = "no part alone is in doubt"
    else:
        why = "questions come with --carving"
    print(f"--ask: there is nothing to ask; {why}.", file=sys.stderr)


def ask(questions: Sequence[Question]) -> dict[int, bool]:
    """The answers by the numbers of the questions; none of those that are skipped."""
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
