"""Messages between the realizer and the speech worker."""

from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.engines.speech.worker_messages import MessageDecoder, WorkerMessage, failure

MESSAGES = st.builds(WorkerMessage, st.dictionaries(st.text(), st.integers()), st.binary(max_size=40))


@settings(derandomize=True)
@given(st.lists(MESSAGES, max_size=5), st.integers(1, 7))
def test_messages_arrive_whole_and_in_order_in_pieces_of_any_size(messages: list[WorkerMessage], size: int) -> None:
    sent = b"".join(message.encode() for message in messages)
    decoder = MessageDecoder()
    pieces = [sent[at : at + size] for at in range(0, len(sent), size)]
    assert [message for piece in pieces for message in decoder.feed(piece)] == messages


def test_a_failure_names_the_signal_or_the_exit_status() -> None:
    assert failure(-9).header == {"failed": "SIGKILL"}
    assert failure(1).header == {"failed": "exit status 1"}
