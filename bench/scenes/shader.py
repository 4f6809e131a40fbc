"""A thin layer over Blender's shader nodes."""
import bpy


class Shader:
    """A material under construction; methods add a node and return its output.

    `uv`: metres along the surface; `rest`: the place on the undeformed part, metres. Both move with the surface."""

    def __init__(self, name):
        self.material = bpy.data.materials.new(name)
        self.material.use_nodes = True
        self.tree = self.material.node_tree
        self.tree.nodes.clear()
        self.uv = self.node("ShaderNodeTexCoord").outputs["UV"]
        self.rest = self.node("ShaderNodeAttribute", attribute_name="rest").outputs["Vector"]

    def node(self, kind, inputs=None, **properties):
        n = self.tree.nodes.new(kind)
        for key, value in properties.items():
            setattr(n, key, value)
        for key, value in (inputs or {}).items():
            self.put(n.inputs[key], value)
        return n

    def put(self, socket, value):
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        elif socket.type == "RGBA":
            socket.default_value = (*value, 1) if not isinstance(value, (int, float)) else (value, value, value, 1)
        else:
            socket.default_value = value

    def scaled(self, vector, scale, offset=(0, 0, 0), turn=0.0):
        scale = (scale, scale, scale) if isinstance(scale, (int, float)) else scale
        return self.node("ShaderNodeMapping", {"Vector": vector, "Scale": scale, "Location": offset,
                                               "Rotation": (0, 0, turn)}).outputs[0]

    def noise(self, vector, scale, detail=3.0, roughness=0.55):
        """About 0.3 to 0.7; `scale` in features per metre."""
        return self.node("ShaderNodeTexNoise", {"Vector": vector, "Scale": scale, "Detail": detail,
                                                "Roughness": roughness}).outputs["Fac"]

    def ramp(self, value, stops, interpolation="LINEAR"):
        """`stops`: (place 0 to 1, grey or RGB)…"""
        n = self.node("ShaderNodeValToRGB", {"Fac": value})
        elements = n.color_ramp.elements
        n.color_ramp.interpolation = interpolation
        while len(elements) < len(stops):
            elements.new(0.5)
        for element, (place, colour) in zip(elements, stops):
            element.position = place
            element.color = (colour,) * 3 + (1,) if isinstance(colour, (int, float)) else (*colour, 1)
        return n.outputs["Color"]

    def mix(self, factor, a, b, how="MIX"):
        return self.node("ShaderNodeMixRGB", {"Fac": factor, "Color1": a, "Color2": b}, blend_type=how).outputs[0]

    def math(self, operation, a, b=0.0):
        n = self.node("ShaderNodeMath", operation=operation)
        self.put(n.inputs[0], a)
        self.put(n.inputs[1], b)
        return n.outputs[0]

    def picture(self, path, vector):
        """The colour of a picture repeated over `vector`, whose unit is the picture."""
        image = bpy.data.images.load(str(path), check_existing=True)
        n = self.node("ShaderNodeTexImage", {"Vector": vector}, image=image)
        return n.outputs["Color"]

    def aov(self, name, colour):
        n = self.node("ShaderNodeOutputAOV", {"Color": colour})
        n.name = name

    def diffuse(self, colour):
        self.finish(self.node("ShaderNodeBsdfDiffuse", {"Color": colour}))

    def under_coat(self, colour):
        """What is left of a diffuse colour under a clear coat: its Fresnel reflection is taken off."""
        self.diffuse(self.mix(self.fresnel(), colour, (0, 0, 0)))

    def coat(self, roughness):
        """The coat's reflection alone."""
        self.finish(self.node("ShaderNodeBsdfGlossy", {"Color": self.fresnel(), "Roughness": roughness}))

    def in_reflections(self, colour):
        """Diffuse where it is reflected, black to the camera."""
        seen = self.node("ShaderNodeLightPath").outputs["Is Camera Ray"]
        self.diffuse(self.mix(seen, colour, (0, 0, 0)))

    def fresnel(self):
        """Schlick's approximation (1994, eq. 15) for an index of 1.5, the same from either side of a face."""
        facing = self.node("ShaderNodeLayerWeight", {"Blend": 0.5}).outputs["Facing"]  # 1 − cosine
        return self.math("ADD", 0.04, self.math("MULTIPLY", 0.96, self.math("POWER", facing, 5.0)))

    def finish(self, shader):
        output = self.node("ShaderNodeOutputMaterial")
        self.tree.links.new(shader.outputs[0], output.inputs["Surface"])
