"""BML before 1.0: documents without a namespace, rewritten as BML 1.0 before they are read.

One tolerant reading serves the draft of the thesis (van Welbergen 2011, chapter 6) and the Vienna draft that SmartBody
reads. Nothing is guessed: what is not known here stays as it is, and the reader of BML 1.0 names it.
"""
