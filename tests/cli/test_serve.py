"""The options of ``serve``: what is refused before anything starts, and where the token comes from."""

from pathlib import Path

import pytest

from reactive_realizer.__main__ import main
from reactive_realizer.cli import serve as command
from reactive_realizer.engines.speech.kokoro.voice import KokoroVoice
from reactive_realizer.server.serve import ServerOptions


@pytest.fixture
def served(monkeypatch: pytest.MonkeyPatch) -> list[ServerOptions]:
    """The options with which servers would have been started."""
    options: list[ServerOptions] = []

    async def serve(given: ServerOptions) -> None:
        options.append(given)

    monkeypatch.setattr(command, "serve", serve)
    return options


def test_the_token_comes_from_an_option_a_file_or_the_environment(
    served: list[ServerOptions], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "token"
    file.write_text("of-the-file\n")
    main(["serve"])
    monkeypatch.setenv("REACTIVE_REALIZER_TOKEN", "of-the-environment")
    main(["serve"])
    main(["serve", "--token", "of-the-option"])
    main(["serve", "--token-file", str(file)])
    assert [each.token for each in served] == [None, "of-the-environment", "of-the-option", "of-the-file"]


@pytest.mark.parametrize("token", [["--token", ""], ["--token-file", "/dev/null"]])
def test_an_empty_token_ends_the_command_with_status_2(token: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["serve", "--host", "0.0.0.0", "--port", "0", *token]) == 2
    assert "the token is empty" in capsys.readouterr().err


def test_an_empty_token_in_the_environment_is_refused_too(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("REACTIVE_REALIZER_TOKEN", "")
    assert main(["serve", "--port", "0"]) == 2
    assert "the token is empty" in capsys.readouterr().err


def test_a_server_that_other_machines_can_reach_does_not_start_without_a_token(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("REACTIVE_REALIZER_TOKEN", raising=False)
    assert main(["serve", "--host", "0.0.0.0", "--port", "0"]) == 2
    assert "a token is required" in capsys.readouterr().err


def test_a_token_file_that_does_not_exist_is_named(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["serve", "--token-file", "nowhere.txt"]) == 2
    assert "nowhere.txt" in capsys.readouterr().err


@pytest.mark.parametrize("port", ["99999", "65536", "-1", "eighty", "9" * 5000])
def test_a_port_that_does_not_exist_is_refused(port: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["serve", f"--port={port}"])
    assert ended.value.code == 2
    assert "is not a port: 0 to 65535" in capsys.readouterr().err


def test_the_size_of_the_files_of_a_recording_is_set_in_megabytes(served: list[ServerOptions]) -> None:
    main(["serve", "--record", "session.jsonl", "--record-size", "2.5"])
    assert served[0].record_bytes == 2_500_000


@pytest.mark.parametrize("options", [["--record-size", "5"], ["--record", "a", "--record-size", "0"]])
def test_a_size_of_recordings_without_a_recording_or_of_nothing_is_refused(
    options: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["serve", *options])
    assert ended.value.code == 2
    assert "--record-size" in capsys.readouterr().err


def test_no_bridge_is_started_unless_it_is_asked_for(served: list[ServerOptions]) -> None:
    main(["serve"])
    main(["serve", "--bridge", "embr", "--bridge", "vhmsg --agent brad=alice"])
    assert [[bridge.name for bridge in each.bridges] for each in served] == [[], ["embr", "vhmsg"]]


def test_the_demo_speaks_with_the_natural_voice_where_it_is_installed(
    served: list[ServerOptions], monkeypatch: pytest.MonkeyPatch
) -> None:
    for installed in (True, False):
        monkeypatch.setattr(KokoroVoice, "installed", lambda found=installed: found)
        main(["demo"])
        main(["demo", "--voice", "text"])
    main(["serve"])
    assert [options.scene.voice for options in served] == ["kokoro", "text", "espeak", "text", "espeak"]


def test_the_demo_serves_the_named_performance(served: list[ServerOptions], capsys: pytest.CaptureFixture[str]) -> None:
    main(["demo"])
    main(["demo", "conductor"])
    assert ['id="greeting"' in (each.performance or "") for each in served] == [True, False]
    assert "conduct-4-beat" in (served[1].performance or "")
    with pytest.raises(SystemExit):
        main(["demo", "dance"])
    assert "there is no performance 'dance'; available: conductor, greeting" in capsys.readouterr().err


def test_a_sound_device_that_does_not_exist_is_an_error(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["serve", "--voice", "text", "--port", "0", "--sound-device", "no such device"]) == 2
    assert "sound cannot be played on this machine: " in capsys.readouterr().err
