"""Ctrl-C, timeouts and other signals while C++ code runs that calls back into Python now and then.

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
    """Holds signals that the program handles back until deliver(), or until the with statement ends."""

    def __init__(self) -> None:
        self._handlers: dict[int, Any] = {}
        self._pending: dict[int, FrameType | None] = {}
        self._is_holding = False

    def __enter__(self) -> Interrupt:
        # Handlers run in the main thread alone; and one that is no function is the system's own.
        if threading.current_thread() is threading.main_thread():
            for number in signal.valid_signals():
                handler = signal.getsignal(number)
                if callable(handler):
                    self._handlers[number] = handler
                    signal.signal(number, self._note)
        self._is_holding = True
        return self

    def __exit__(self, *_: object) -> None:
        self._is_holding = False
        for number, handler in self._handlers.items():
            signal.signal(number, handler)
        self.deliver()

    def deliver(self) -> None:
        """Calls the program's own handlers; that of Ctrl-C usually raises KeyboardInterrupt."""
        while self._pending:
            number, frame = self._pending.popitem()
            self._handlers[number](number, frame)

    def _note(self, number: int, frame: FrameType | None) -> None:
        # A handler may raise while others are being replaced or put back; what then stays behind
        # passes its signal on.
        if self._is_holding:
            self._pending[number] = frame
        else:
            self._handlers[number](number, frame)
