"""usage: kubernetes_schema.py SWAGGER.json MANIFEST.yaml: whether a job is what Kubernetes' OpenAPI schema says, without fields
that the schema does not know. The schema is that of a release: kubernetes/swagger.json.unprocessed of kubernetes-client/python."""
import json
import sys

import jsonschema
import yaml

definitions = json.load(open(sys.argv[1], encoding="utf-8"))["definitions"]
for schema in list(definitions.values()):
    if "properties" in schema:
        schema.setdefault("additionalProperties", False)
    # Numbers and strings alike, which the schema gives as strings.
    for each in [schema, *schema.get("properties", {}).values()]:
        if each.get("format") == "int-or-string":
            each["type"] = ["integer", "string"]
definitions["io.k8s.apimachinery.pkg.api.resource.Quantity"]["type"] = ["number", "string"]

manifest = yaml.safe_load(open(sys.argv[2], encoding="utf-8"))
validator = jsonschema.Draft4Validator({"$ref": "#/definitions/io.k8s.api.batch.v1.Job", "definitions": definitions})
findings = [f"{'/'.join(map(str, each.absolute_path))}: {each.message}" for each in validator.iter_errors(manifest)]
print("\n".join(findings) or "the manifest fits the schema")
sys.exit(bool(findings))
