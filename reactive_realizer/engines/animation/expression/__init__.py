"""The formulas of animation files: read, checked, simplified, and turned into a function once.

A formula is a text of numbers, names, `+ - * / % ^`, comparisons and `&& || !` (1 where they hold, else 0),
`if(condition, a, b)` and the functions that it may call. Nothing else has a meaning, so a formula from anywhere can do
no harm. It knows neither animations nor bodies.
"""
