"""The command line: help for everything, one-line errors, exit statuses."""

import subprocess
import sys

import pytest
import typer

from kirby.cli import app

COMMANDS = sorted(typer.main.get_command(app).commands)


def kirby(*arguments: str, said: str = "") -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "kirby", *arguments],
        input=said,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_has_help_with_an_example(command):
    shown = kirby(command, "--help")
    assert shown.returncode == 0
    assert f"Example: kirby {command}" in shown.stdout or f"| kirby {command}" in shown.stdout


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("fly",), "No such command 'fly'"),
        (("parse", "--loud", "stop"), "No such option"),
        (("parse", "--world", "nowhere", "stop"), "nowhere"),
        (("corpus", "no_such_file.yaml"), "no_such_file.yaml"),
        (("bench", "patience"), "simulation"),
        (("--speed", "fast"), "speed"),
        (("--speed", "-1"), "speed"),
    ],
)
def test_wrong_use_is_one_line_and_status_2(arguments, says):
    shown = kirby(*arguments)
    assert shown.returncode == 2
    assert shown.stdout == ""
    assert shown.stderr.startswith("kirby: ")
    assert says in shown.stderr
    assert shown.stderr.count("\n") == 1
