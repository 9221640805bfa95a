"""Small DXF drawings for tests."""


class Drawing:
    def __init__(self, unit=4, layers=()):
        """`unit` is $INSUNITS; a layer is its name and its colour, which is negative where it is off."""
        self.text = f"0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n{unit}\n0\nENDSEC\n"
        if layers:
            self.text += "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n70\n9\n"
            for name, colour in layers:
                self.text += f"0\nLAYER\n2\n{name}\n70\n0\n62\n{colour}\n"
            self.text += "0\nENDTAB\n0\nENDSEC\n"
        self.text += "0\nSECTION\n2\nENTITIES\n"

    def add(self, kind, layer, *pairs):
        self.text += f"0\n{kind}\n8\n{layer}\n" + "".join(f"{code}\n{value}\n" for code, value in pairs)
        return self

    def line(self, layer, a, b, c, d):
        return self.add("LINE", layer, (10, a), (20, b), (11, c), (21, d))

    def box(self, layer, a, b, c, d):
        """A closed polyline."""
        return self.add("LWPOLYLINE", layer, (90, 4), (70, 1), (10, a), (20, b), (10, c), (20, b),
                        (10, c), (20, d), (10, a), (20, d))

    def __str__(self):
        return self.text + "0\nENDSEC\n0\nEOF\n"
