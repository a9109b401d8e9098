"""Ctrl-C while C++ code runs that calls back into Python now and then.

Python runs a signal's handler between any two of its instructions, the first ones of a callback
included, before they can catch what the handler raises. So another handler takes its place, which
only notes the signal, and the program's own one is called where its exception is expected.
"""

from __future__ import annotations

import signal
import threading
from types import FrameType
from typing import Any


class Interrupt:
    """Holds SIGINT back until deliver(), or until the end of the with statement."""

    def __init__(self) -> None:
        self._handler: Any = None
        self._frame: FrameType | None = None
        self._is_pending = False

    def __enter__(self) -> Interrupt:
        handler = signal.getsignal(signal.SIGINT)
        # Handlers run in the main thread alone; and one that is no function is the system's own.
        if callable(handler) and threading.current_thread() is threading.main_thread():
            self._handler = handler
            signal.signal(signal.SIGINT, self._note)
        return self

    def __exit__(self, *_: object) -> None:
        if self._handler is not None:
            signal.signal(signal.SIGINT, self._handler)
            self.deliver()

    def deliver(self) -> None:
        """Calls the program's own handler, which usually raises KeyboardInterrupt."""
        if self._is_pending:
            self._is_pending = False
            self._handler(signal.SIGINT, self._frame)

    def _note(self, _signal: int, frame: FrameType | None) -> None:
        self._frame = frame
        self._is_pending = True
