"""The engine of characters that are shown by pictures (thesis 10.1.3.1, PictureEngine)."""
