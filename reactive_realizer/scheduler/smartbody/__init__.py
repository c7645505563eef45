"""The strategy `smartbody`: behaviors one by one, in Elckerlyc's order (thesis 7.2.2, 7.3.5)."""
