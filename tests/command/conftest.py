"""Common parts of tests of the command: it in any folder, with signals and with its errors on a terminal."""

import os
import pty
import select
import signal
import subprocess
import time
from types import SimpleNamespace

import pytest
from command_scenes import BAR, CHAIN, CHAIN_FILES, STOP, STOP_AT

PROGRAM = os.environ["WAVEBALANCE_COMMAND"]


class Running:
    """A command that runs in parallel with the test, its errors in a file or on a terminal, where progress shows
    sooner."""

    def __init__(self, folder, arguments, terminal):
        self.folder, self.seen, self.reader = folder, "", None
        errors = (folder / "stderr").open("w")
        if terminal:
            errors.close()
            self.reader, writer = pty.openpty()
            errors = os.fdopen(writer, "w")
        with errors, (folder / "stdout").open("w") as output:
            self.process = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=folder, stdout=output, stderr=errors,
                                            preexec_fn=take_interrupts)

    def errors(self):
        """All that was written so far."""
        if self.reader is None:
            return (self.folder / "stderr").read_text()
        while select.select([self.reader], [], [], 0)[0] and self.read():
            pass
        return self.seen

    def read(self):
        try:
            part = os.read(self.reader, 4096)
        except OSError:  # the last program with this terminal has ended
            part = b""
        self.seen += part.decode()
        return part

    def wait_until(self, done, seconds=60):
        """Waits until `done` holds, within the time."""
        end = time.monotonic() + seconds
        while not done():
            assert time.monotonic() < end, self.errors()
            time.sleep(0.01)

    def send(self, sent):
        self.process.send_signal(sent)

    def wait(self):
        """Exit code and all errors, which are read as they come: a full terminal would stop the command."""
        self.wait_until(lambda: self.errors() is not None and self.process.poll() is not None)
        return SimpleNamespace(code=self.process.returncode, errors=self.errors())


def take_interrupts():
    """A shell lets what it begins in the background ignore them."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@pytest.fixture
def begin(tmp_path):
    """Begins a command, which ends with the test at the latest."""
    begun = []

    def start(*arguments, terminal=False):
        begun.append(Running(tmp_path, arguments, terminal))
        return begun[-1]

    yield start
    for one in begun:
        one.process.kill()
        one.process.wait()
        if one.reader is not None:
            os.close(one.reader)


@pytest.fixture
def bar(tmp_path):
    """The file of a scene of a bar."""
    (tmp_path / "case.toml").write_text(BAR)
    return tmp_path / "case.toml"


@pytest.fixture
def masses(tmp_path):
    """The file of a scene of three masses with the files of its matrices."""
    for name, text in CHAIN_FILES.items():
        (tmp_path / name).write_text(text)
    (tmp_path / "case.toml").write_text(CHAIN)
    return tmp_path / "case.toml"


@pytest.fixture
def stop(tmp_path):
    """Writes the scene of an oscillator with a stop, a frequency sweep or without an analysis; returns its file."""

    def write(sweep=True):
        (tmp_path / f"stop_{sweep}.toml").write_text(STOP if sweep else STOP_AT)
        return tmp_path / f"stop_{sweep}.toml"

    return write
