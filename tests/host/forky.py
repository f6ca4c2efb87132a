# SPDX-License-Identifier: GPL-3.0-or-later
"""MeshLab 2025.07 as Debian forky has it, in a folder of its own: made once, by root, with a network; about a minute."""
import contextlib
import fcntl
import os
import pathlib
import shutil
import subprocess

from hosts import CACHE, NotHere

ROOT_FOLDER = CACHE / 'forky-meshlab'
# MeshLab, what its plugins need but its package does not ask for, and what ours needs.
PACKAGES = ('meshlab', 'libgomp1', 'libmuparser2v5', 'libqhull-r8.0', 'lib3ds-1-3', 'libopenctm1', 'libhpdf-2.3.0')
SECONDS = 600  # for each of the two steps, which take half a minute where nothing else runs
LAST_LIBRARY = pathlib.Path('usr/lib/x86_64-linux-gnu/libhpdf-2.3.0.so')  # of the last package
PLUGINS = pathlib.Path('usr/lib/x86_64-linux-gnu/meshlab/plugins')


def _mirror():
    """Where this machine gets Debian from."""
    run = subprocess.run(['apt-get', 'indextargets', '--format', '$(REPO_URI) $(RELEASE) $(CREATED_BY)'],
                         capture_output=True, text=True)
    release = dict(line.rstrip().split('=', 1) for line in open('/etc/os-release') if '=' in line)
    for line in run.stdout.splitlines():
        words = line.split()
        if len(words) == 3 and words[1] == release.get('VERSION_CODENAME') and words[2] == 'Packages':
            return words[0]
    raise NotHere("this machine's apt configuration names no Debian mirror")


def _run(what, command):
    log = CACHE / 'forky-meshlab.log'
    try:
        with open(log, 'w') as out:
            done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.STDOUT,
                                  timeout=SECONDS).returncode == 0
    except subprocess.TimeoutExpired:
        done = False
    if not done:
        raise NotHere(f'{what} did not work (is there a network?); its log is {log}')


def inside(root, *command):
    """The command as it is run in the folder."""
    return ['chroot', str(root), '/usr/bin/env', 'PATH=/usr/sbin:/usr/bin:/sbin:/bin',
            # Debian's package leaves the folder of MeshLab's own libraries to the caller.
            'LD_LIBRARY_PATH=/usr/lib/x86_64-linux-gnu/meshlab', *map(str, command)]


def _remove(root):
    """Removes what a try left that was stopped. debootstrap mounts file systems there, which must not be emptied."""
    mounted = [line.split()[1] for line in open('/proc/mounts') if line.split()[1].startswith(f'{root}/')]
    for folder in sorted(mounted, reverse=True):
        subprocess.run(['umount', '--lazy', folder], check=True)
    shutil.rmtree(root, ignore_errors=True)


def _install(root):
    shutil.copy('/etc/resolv.conf', root / 'etc' / 'resolv.conf')
    install = 'apt-get -q -o Acquire::Check-Valid-Until=false update && apt-get -q -y install ' \
              '--no-install-recommends ' + ' '.join(PACKAGES) + ' && apt-get clean'
    _run('installing MeshLab 2025.07', inside(root, 'env', 'DEBIAN_FRONTEND=noninteractive', 'sh', '-c', install))


@contextlib.contextmanager
def _alone():
    """One process at a time: tests run in two."""
    CACHE.mkdir(parents=True, exist_ok=True)
    with open(CACHE / 'forky-meshlab.lock', 'w') as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def root_folder():
    """The folder, made when it is not there. Raises NotHere with the reason."""
    with _alone():
        return _made_folder()


def _made_folder():
    if (ROOT_FOLDER / PLUGINS).exists():
        if not (ROOT_FOLDER / LAST_LIBRARY).exists():  # made when fewer packages were needed
            _install(ROOT_FOLDER)
        return ROOT_FOLDER
    if os.geteuid() != 0:
        raise NotHere('only root can make a folder with Debian forky for MeshLab 2025.07')
    if not shutil.which('debootstrap'):
        raise NotHere('debootstrap is not installed (Debian 12: apt-get install debootstrap)')
    mirror = _mirror()
    new = CACHE / 'forky-meshlab.new'
    _remove(new)
    # bookworm's debootstrap does not know forky; sid's way of doing it fits.
    _run('debootstrap of forky', ['debootstrap', '--variant=minbase', 'forky', str(new), mirror,
                                  '/usr/share/debootstrap/scripts/sid'])
    (new / 'usr/sbin/policy-rc.d').write_text('#!/bin/sh\nexit 101\n')  # start no services
    (new / 'usr/sbin/policy-rc.d').chmod(0o755)
    _install(new)
    new.rename(ROOT_FOLDER)
    return ROOT_FOLDER
