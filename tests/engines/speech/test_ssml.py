"""A text with marks as SSML, and the way back."""

from hypothesis import given, settings
from hypothesis import strategies as st
from lxml import etree

from reactive_realizer.engines.speech.ssml import marked_up

TEXTS = st.text(st.characters(exclude_categories=["Cs", "Cc"]), max_size=30)


def test_marks_stand_where_they_were_asked_for_and_are_numbered():
    assert marked_up("ab", (2, 0)).ssml == '<speak><mark name="m1"/>ab<mark name="m0"/></speak>'


def test_marks_at_one_place_keep_their_order():
    assert marked_up("a", (0, 0)).ssml == '<speak><mark name="m0"/><mark name="m1"/>a</speak>'


def test_a_position_in_the_ssml_counts_from_one_and_leads_back_to_the_text():
    markup = marked_up("a & b", (4,))
    assert markup.origin(markup.ssml.index("b") + 1) == 4
    assert markup.origin(markup.ssml.index("amp;") + 1) == 2


def test_a_tag_stands_for_what_follows_it_and_positions_outside_for_the_ends():
    markup = marked_up("a b", (2,))
    assert markup.origin(markup.ssml.index("<mark") + 1) == 2
    assert (markup.origin(0), markup.origin(1000)) == (0, 3)


@settings(derandomize=True)
@given(text=TEXTS, data=st.data())
def test_the_ssml_is_xml_with_the_same_text_whatever_the_text(text, data):
    marks = tuple(data.draw(st.lists(st.integers(0, len(text)), max_size=4)))
    markup = marked_up(text, marks)
    root = etree.fromstring(markup.ssml)
    assert "".join(root.itertext()) == text
    assert sorted(mark.get("name") for mark in root) == sorted(f"m{n}" for n in range(len(marks)))
    for mark in root:
        place = marks[int(mark.get("name")[1:])]
        assert "".join(root.xpath("//mark[@name=$name]/preceding::text()", name=mark.get("name"))) == text[:place]


@settings(derandomize=True)
@given(TEXTS)
def test_every_character_of_the_text_is_found_again(text):
    origins = marked_up(text, ()).origins
    assert sorted(set(origins)) == list(range(len(text) + 1))
