# SPDX-License-Identifier: GPL-3.0-or-later
"""scripts/check_mlx.py says what is wrong with a filter script."""
import pathlib
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).parents[2]
EXAMPLE = (ROOT / "examples" / "texture_atlas.mlx").read_text(encoding="utf-8")
PADDING = next(line for line in EXAMPLE.splitlines() if 'name="padding"' in line)


def check(*files):
    run = subprocess.run([sys.executable, ROOT / "scripts" / "check_mlx.py", *files], capture_output=True, text=True)
    assert "Traceback" not in run.stderr
    return run.returncode, run.stdout


def test_the_shipped_scripts_are_right():
    code, said = check(*sorted((ROOT / "examples").glob("*.mlx")))
    assert code == 0 and said.count("nothing is wrong") == 4
    assert "D-Charts filters: 6" in said  # stages.mlx


def changed(attribute, value, name="padding"):
    line = next(line for line in EXAMPLE.splitlines() if f'name="{name}"' in line)
    start = line.index(f'{attribute}="') + len(attribute) + 2
    return EXAMPLE.replace(line, line[:start] + value + line[line.index('"', start):])


@pytest.mark.parametrize("text, sentence", [
    (changed("name", "pading"), "'pading' is no parameter of D-Charts: Texture Atlas. Did you mean 'padding'?"),
    (changed("name", "pading"), "lacks 'padding'. Add: <Param name=\"padding\" type=\"RichInt\""),
    (EXAMPLE.replace(PADDING + "\n", ""), "lacks 'padding'"),
    (EXAMPLE.replace(PADDING, PADDING + PADDING), "'padding' is there twice"),
    (changed("type", "RichFloat"), "'padding' has the type 'RichFloat', but it is 'RichInt'"),
    (changed("value", "four"), "padding: 'four' is no whole number"),
    (changed("value", "1.5"), "padding: '1.5' is no whole number"),
    (changed("value", "-1"), "padding: -1 is below 0"),
    (changed("value", "nan", "max_fitting_error"), "'nan' is not finite"),
    (changed("value", "0", "max_fitting_error"), "0 is not above 0"),
    (changed("value", "5", "max_fitting_error"), "5 is above 4"),
    (changed("value", "yes", "selected_only"), "'yes' is neither true nor false"),
    (changed("value", "7", "merge_by"), "merge_by: '7' is none of 0 ("),
    (changed("value", "Trial", "merge_by"), "merge_by: 'Trial' is none of 0 ("),
    (PADDING.join(EXAMPLE.split(PADDING)).replace(PADDING, '<Param name="padding"/>'), "without type and value"),
    (EXAMPLE.replace("D-Charts: Texture Atlas", "D-Charts: Texture Altas"), "Did you mean 'D-Charts: Texture Atlas'?"),
])
def test_a_mistake_is_named_with_its_line(text, sentence, tmp_path):
    script = tmp_path / "script.mlx"
    script.write_text(text, encoding="utf-8")
    code, said = check(script)
    assert code == 1 and sentence in said, said
    assert all(line.startswith(f"{script}:") and line[len(f"{script}:")].isdigit() for line in said.splitlines())


def test_filters_of_others_are_left_alone(tmp_path):
    script = tmp_path / "script.mlx"
    script.write_text('<!DOCTYPE FilterScript>\n<FilterScript>\n<filter name="Laplacian Smooth"/>\n'
                      '<xmlfilter name="D-Charts of others"/>\n</FilterScript>\n')
    assert check(script) == (0, f"{script}: nothing is wrong. D-Charts filters: 0; filters not looked at: 2\n")


@pytest.mark.parametrize("content, sentence", [
    (b"", "it is no XML"), (b"\x00\xff\x01", "it is no XML"), (b"<a/>", "starts with <FilterScript>"),
    (b'<!DOCTYPE F [<!ENTITY a "b">]><FilterScript>&a;</FilterScript>', "entities"),
    (b"<FilterScript><filter>", "it is no XML"),
])
def test_what_is_no_script_is_said(content, sentence, tmp_path):
    script = tmp_path / "script.mlx"
    script.write_bytes(content)
    code, said = check(script)
    assert code == 2 and sentence in said
    assert check(tmp_path / "none.mlx")[0] == 2 and check(tmp_path)[0] == 2 and check()[0] == 2
