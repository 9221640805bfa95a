<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>
<qgis version="3.22" styleCategories="Symbology">
  <renderer-v2 type="singleSymbol" symbollevels="0" enableorderby="0">
    <symbols>
      <symbol type="line" name="0" alpha="1" clip_to_extent="1">
        <layer class="SimpleLine" pass="0" locked="0" enabled="1">
          <Option type="Map">
            <Option type="QString" name="line_color" value="200,200,200,255"/>
            <Option type="QString" name="line_width" value="0.5"/>
            <Option type="QString" name="line_width_unit" value="MM"/>
          </Option>
          <data_defined_properties>
            <Option type="Map">
              <Option type="QString" name="name" value=""/>
              <Option type="Map" name="properties">
                <Option type="Map" name="outlineColor">
                  <Option type="bool" name="active" value="true"/>
                  <Option type="int" name="type" value="3"/>
                  <Option type="QString" name="expression" value="if(attribute('t1024_choice') is null, '200,200,200,255', ramp_color(create_ramp(map(0, '48,18,59', 0.25, '40,170,225', 0.5, '164,252,60', 0.75, '251,128,34', 1, '122,4,3')), coalesce(scale_linear(ln(1 + attribute('t1024_choice')), minimum(ln(1 + attribute('t1024_choice'))), maximum(ln(1 + attribute('t1024_choice'))), 0, 1), 0.5)))"/>
                </Option>
              </Option>
              <Option type="QString" name="type" value="collection"/>
            </Option>
          </data_defined_properties>
        </layer>
      </symbol>
    </symbols>
  </renderer-v2>
</qgis>
