# SPDX-License-Identifier: GPL-3.0-or-later
"""A private X display with a window manager, and what is to be seen on it."""
import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
import time

import numpy as np
from PIL import Image

TOOLS = ('Xvfb', 'openbox', 'xdotool')


def missing_tools():
    """Names of the programs that are needed and not installed."""
    return [t for t in TOOLS if not shutil.which(t)]


class XSession:
    """Xvfb on a free display, with openbox (without a window manager keyboard focus is a matter of luck)."""

    def __init__(self, width=1280, height=900):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix='dcharts-x-'))
        self.processes = []
        read, write = os.pipe()
        self._start(['Xvfb', '-displayfd', str(write), '-screen', '0', f'{width}x{height}x24', '-fbdir', str(self.folder),
                     '-nolisten', 'tcp', '+extension', 'GLX'], pass_fds=(write,))
        os.close(write)
        with os.fdopen(read) as numbers:
            number = numbers.readline().strip()
        if not number:
            raise RuntimeError('Xvfb did not start')
        self.env = {**os.environ, 'DISPLAY': f':{number}', 'LIBGL_ALWAYS_SOFTWARE': '1'}
        self._start(['openbox', '--sm-disable'], env=self.env)

    def _start(self, command, **options):
        self.processes.append(subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **options))

    def close(self):
        for process in reversed(self.processes):
            process.terminate()
        for process in reversed(self.processes):
            process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def xdotool(self, *arguments):
        """What xdotool printed; empty when it found nothing."""
        run = subprocess.run(['xdotool', *map(str, arguments)], env=self.env, capture_output=True, text=True, timeout=60)
        return run.stdout.strip()

    def keys(self, *keys):
        self.xdotool('key', '--clearmodifiers', '--delay', '60', *keys)

    def write(self, text):
        self.xdotool('type', '--clearmodifiers', '--delay', '20', text)

    def wait_for_window(self, title, seconds=20):
        """The id of the visible window titled exactly `title`."""
        pattern = '^' + ''.join('\\' + c if c in r'\.[]{}()*+?|^$' else c for c in title) + '$'
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            found = self.xdotool('search', '--all', '--onlyvisible', '--name', pattern).split()
            if found:
                return found[-1]
            time.sleep(0.2)
        raise TimeoutError(f'no window "{title}" in {seconds} s')

    def screen(self):
        """The screen now, an array of height x width x 3 bytes (RGB). Xvfb keeps it in a file in XWD format."""
        data = (self.folder / 'Xvfb_screen0').read_bytes()
        header = struct.unpack('>25I', data[:100])
        offset, width, height, line, colors = header[0], header[4], header[5], header[12], header[19]
        start = offset + colors * 12
        rows = np.frombuffer(data, np.uint8, line * height, start).reshape(height, line)
        return np.ascontiguousarray(rows[:, :width * 4].reshape(height, width, 4)[:, :, 2::-1])

    def save_screen(self, path):
        path = pathlib.Path(path)
        path.parent.mkdir(parents=True, exist_ok=True)
        Image.fromarray(self.screen()).save(path)
