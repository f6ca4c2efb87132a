# SPDX-License-Identifier: GPL-3.0-or-later
"""Drives a MeshLab GUI by keyboard: opens a mesh, applies filters by name, looks at the 3D view."""
import re
import subprocess
import tempfile
import threading
import time

import numpy as np


class MeshlabGui:
    """A running MeshLab on an XSession. What it writes to stderr (its log among it) is in `output`."""

    def __init__(self, session, command, mesh, env=None, seconds=90, first_field=2, folder=None):
        """`first_field`: how often Tab is pressed from Apply to a filter's first field; 2 in 2020.09, 3 in 2025.07."""
        self.session = session
        self.first_field = first_field
        self.home = tempfile.TemporaryDirectory(prefix='dcharts-home-')  # keeps the user's own settings out
        own_env = {'HOME': self.home.name, 'XDG_RUNTIME_DIR': self.home.name}
        self.process = subprocess.Popen([*map(str, command), str(mesh)], env={**session.env, **own_env, **(env or {})},
                                        cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors='replace')
        self.lines = []
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()
        self.wait_for_output('All files opened', seconds)

    def _read(self):
        for line in self.process.stdout:
            self.lines.append(line.rstrip('\n'))

    @property
    def output(self):
        return '\n'.join(self.lines)

    def wait_for_output(self, text, seconds=120):
        """Waits for a text on MeshLab's stdout or stderr; `text` is a regular expression."""
        end = time.monotonic() + seconds
        while not re.search(text, self.output):
            if self.process.poll() is not None:
                self._reader.join(5)
                raise RuntimeError(f'MeshLab ended ({self.process.returncode}) before "{text}":\n{self.output[-2000:]}')
            if time.monotonic() > end:
                raise TimeoutError(f'no "{text}" in {seconds} s:\n{self.output[-2000:]}')
            time.sleep(0.1)

    def main_window(self):
        ids = self.session.xdotool('search', '--all', '--onlyvisible', '--pid', self.process.pid, '--name', '^MeshLab')
        return ids.split()[-1]

    def open_filter(self, name):
        """Opens the filter's dialog by MeshLab's search box; returns its window."""
        self.choose(name)
        return self.session.wait_for_window(name)

    def choose(self, name, line=1):
        """Chooses what the search box finds first (or in another line): a filter, or an entry of the menus Edit and Render."""
        self.session.xdotool('windowactivate', '--sync', self.main_window())
        self.session.keys('ctrl+f')
        time.sleep(0.5)
        self.session.write(name)
        time.sleep(1)
        self.session.keys(*['Down'] * line, 'Return')

    def apply(self, name, seconds=240, typed=None, saved_as=None, chosen=None, ticked=()):
        """Applies a filter, waits until MeshLab says it is done, and takes the filter's dialog off the screen. Parameters
        have their defaults, but for what is typed into fields: {number of the field, from 0: text}, for what is chosen in
        menus: {number of the field: line, from 0}, for boxes that are `ticked` (numbers of the fields), and for the name of a file to write, the last of them: (number of the
        field, text), given in the dialog behind its button (2020.09 does not look at what is typed beside that)."""
        window = self.open_filter(name)
        height = int(re.search(r'Geometry: \d+x(\d+)', self.session.xdotool('getwindowgeometry', window)).group(1))
        assert height <= 1050, f'the dialog of {name} is {height} pixels high: Apply is below a screen of 1080'
        self.session.xdotool('windowactivate', '--sync', window)
        time.sleep(0.3)
        done = len(self.applied(name))
        place = 0  # on Apply, which has the focus
        for field, value in sorted({**(typed or {}), **(chosen or {}), **dict.fromkeys(ticked)}.items()):
            self._step(self.first_field + field - place)
            place = self.first_field + field
            if value is None:
                self.session.keys('space')
                continue
            if isinstance(value, int):
                self.session.keys('Home', *['Down'] * value)
                continue
            self.session.keys('ctrl+a')
            self.session.write(value)
        if saved_as:
            self._step(self.first_field + saved_as[0] + 1 - place)
            place = self.first_field + saved_as[0] + 1
            self.session.keys('space')
            self.session.wait_for_window('Save')
            time.sleep(0.5)
            self.session.keys('ctrl+a')
            self.session.write(saved_as[1])
            self.session.keys('Return')
            time.sleep(1)
            self.session.xdotool('windowactivate', '--sync', window)
        self._step(-place)
        self.session.keys('space')
        self.wait_for_output(f'(?s)(Applied filter:? {re.escape(name)} in.*){{{done + 1}}}', seconds)
        self.session.xdotool('windowunmap', '--sync', window)
        time.sleep(1)

    def save_script(self, path):
        """Saves what was applied so far as a filter script, by the dialog of MeshLab's menu."""
        dialog = self._open_script_dialog()
        self._press_in_script_dialog('Save Script')
        self._name_file('Save Filter Script File', path)
        self.session.xdotool('windowactivate', '--sync', dialog)
        self.session.keys('Escape')

    def run_script(self, path, last, seconds=240):
        """Opens a filter script in the dialog of MeshLab's menu, applies it, and waits until its last filter is done."""
        done = len(re.findall(f'Re-Applied filter {re.escape(last)}', self.output))
        dialog = self._open_script_dialog()
        self._press_in_script_dialog('Open Script')
        self._name_file('Open Filter Script File', path)
        self.session.xdotool('windowactivate', '--sync', dialog)
        self._press_in_script_dialog('Apply Script', place='Open Script')
        self.wait_for_output(f'(?s)(Re-Applied filter {re.escape(last)}.*){{{done + 1}}}', seconds)

    def _open_script_dialog(self):
        self.session.xdotool('windowactivate', '--sync', self.main_window())
        self.session.keys('alt+l')
        time.sleep(0.5)
        # The entry before it, for the last filter again, is there as soon as one was applied by its own dialog.
        self.session.keys(*['Down'] * bool(re.search('(?<!Re-)Applied filter', self.output)), 'Return')
        return self.session.wait_for_window('Dialog')

    def _press_in_script_dialog(self, button, place='the list'):
        """The dialog's fields by Tab; `place` has the focus."""
        order = ('the list', 'Move Up', 'Move Down', 'Remove', 'Edit Parameters', 'Save Script', 'Open Script',
                 'Clear Script', 'Apply Script', 'Close')
        time.sleep(0.5)
        self._step(order.index(button) - order.index(place))
        self.session.keys('space')

    def _name_file(self, title, path):
        self.session.wait_for_window(title)
        time.sleep(0.5)
        self.session.keys('ctrl+a')
        self.session.write(str(path))
        self.session.keys('Return')
        time.sleep(1)

    def apply_at_once(self, name, seconds=60):
        """Applies a filter that has no parameters, and so no dialog."""
        done = len(self.applied(name))
        self.choose(name)
        self.wait_for_output(f'(?s)(Applied filter:? {re.escape(name)} in.*){{{done + 1}}}', seconds)

    def _step(self, count):
        if count:
            self.session.keys(*(['Tab'] if count > 0 else ['shift+Tab']) * abs(count))

    def applied(self, name):
        """What MeshLab says of each time that a filter was applied."""
        return re.findall(f'Applied filter:? {re.escape(name)} in', self.output)

    def colors(self):
        """Number of distinct hues that cover part of the screen: saturated pixels, hue in 5-degree steps, each step of
        at least 100 pixels. MeshLab's own blue and violet backdrop counts too: compare with before the filter."""
        rgb = self.session.screen().reshape(-1, 3).astype(int)
        high, low = rgb.max(1), rgb.min(1)
        spread = high - low
        strong = (spread > 60) & (high > 80)
        r, g, b = rgb[strong].T
        d = spread[strong]
        m = high[strong]
        hue = np.where(m == r, (g - b) / d % 6, np.where(m == g, (b - r) / d + 2, (r - g) / d + 4)) * 60
        counts = np.bincount((hue / 5).astype(int), minlength=72)
        return int((counts >= 100).sum())

    def wait_for_colors(self, least, seconds=20):
        """Waits until so many hues are seen, or not: it may take a while after a filter until the view is drawn anew."""
        end = time.monotonic() + seconds
        while self.colors() < least and time.monotonic() < end:
            time.sleep(0.5)

    def has_line(self, pattern):
        return any(re.search(pattern, line) for line in self.lines)

    def close(self):
        self.process.kill()
        self.process.wait()
        self._reader.join(5)
        self.home.cleanup()
