"""SmartBody's dialect of BML: its requests, and the elements and attributes that it adds, as BML 1.0 and extensions."""
